import assert from "node:assert/strict";
import { test } from "node:test";
import type { ParameterInfo } from "../api/contract.ts";
import { parse, range, shown } from "./value.ts";

const INFO: ParameterInfo = {
  id: "AP4.0",
  group: "Axis",
  axis: "0",
  name: "Maximum positioning speed",
  symbol: "APMaxPositioningSpeed",
  unit: "int",
  text: "",
  section: "4",
  low: 1,
  high: 2047,
  default: 1000,
  decimals: 0,
  readable: true,
  writable: true,
  stored: true,
  is_text: false,
  role: "high_speed",
  is_setting: true,
};
const RATIO: ParameterInfo = { ...INFO, id: "SLRX", low: 0.001, high: 999.999, decimals: 3 };
const NAME: ParameterInfo = { ...INFO, id: "DN", low: null, high: null, is_text: true };

function check(info: ParameterInfo, text: string, expected: number | string, problem = false) {
  const entered = parse(info, text);
  if (entered.ok) assert.deepEqual([entered.value, false], [expected, problem], text);
  else assert.deepEqual([entered.problem, true], [expected, problem], text);
}

test("numbers as people type them", () => {
  check(INFO, " 2 000", 2000);
  check(INFO, "0x7fF", 2047);
  check(RATIO, "2.5", 2.5);
  check(RATIO, "0.3", 0.3);
  check({ ...INFO, low: -64 }, "−12", -12);
});

test("what is no value says why", () => {
  check(INFO, "", "This is a number.", true);
  check(INFO, "12a", "This is a number.", true);
  check(INFO, "0", "At least 1.", true);
  check(INFO, "2048", "At most 2047.", true);
  check(INFO, "1.5", "Whole numbers only.", true);
  check(RATIO, "1.2345", "At most 3 decimals.", true);
  check(NAME, "x".repeat(65), "At most 64 characters.", true);
});

test("text, and how values and ranges are shown", () => {
  check(NAME, " 2ED05 ", "2ED05");
  assert.equal(shown(RATIO, 2.5), "2.500");
  assert.equal(shown(NAME, "2ED05"), "2ED05");
  assert.equal(range(INFO), "1 to 2047");
  assert.equal(range(NAME), "text");
  assert.equal(range({ ...INFO, low: -(2 ** 31), high: 2 ** 31 - 1 }), "32 bits");
  assert.equal(range({ ...INFO, low: null, high: null }), "");
});
