import assert from "node:assert/strict";
import { test } from "node:test";
import { clock, count, decimal, parseNumber, parseWhole, reading } from "./format.ts";

test("whole numbers that people type", () => {
  const check = (text: string, expected: number | null) => assert.equal(parseWhole(text), expected, text);
  check("12", 12);
  check("-12", -12);
  check("+7", 7);
  check(" 1 000 ", 1000);
  check("\u22121\u2009000", -1000);
  check("0xff", 255);
  check("-0x10", -16);
  check("", null);
  check("-", null);
  check("1.5", null);
  check("1e3", null);
  check("99999999999999999999", null);
});

test("numbers with decimals", () => {
  const check = (text: string, expected: number | null) => assert.equal(parseNumber(text), expected, text);
  check("1.5", 1.5);
  check("-.5", -0.5);
  check("2.", 2);
  check("0x10", 16);
  check("1,5", null);
  check(".", null);
});

test("numbers that people read", () => {
  assert.equal(count(-1234567), "\u22121\u2009234\u2009567");
  assert.equal(count(0), "0");
  assert.equal(count(null), "–");
  assert.equal(count(Number.NaN), "–");
  assert.equal(decimal(-0.456, 2), "\u22120.46");
  assert.equal(reading(-1500), "\u22121\u2009500");
  assert.equal(reading(24.5), "24.5");
  assert.equal(reading(0.251), "0.25");
  assert.equal(clock(3725.99), "1:02:05.9");
});
