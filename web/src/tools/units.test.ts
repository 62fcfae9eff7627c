import assert from "node:assert/strict";
import { test } from "node:test";
import { convert, readable, units, type Counting, type Drive, type Quantity } from "./units.ts";

const DRIVE: Drive = { fullSteps: 200, microsteps: 256, mmPerTurn: 5 };
const CHIP: Counting = { divisors: { pulse: 3, ramp: 7 } };

function check(quantity: Quantity, counting: Counting, value: number, from: string, expected: Record<string, string>) {
  const list = units(quantity, DRIVE, counting);
  const unit = list.find(({ id }) => id === from);
  assert.ok(unit, from);
  const shown = Object.fromEntries(convert(value, unit, list).map(({ unit, shown }) => [unit.id, readable(shown)]));
  assert.deepEqual(shown, expected);
}

test("one turn a second is 51,200 pps (manual, 6.1.4)", () => {
  check("speed", {}, 51_200, "pulses", { pulses: "51200", full: "200", turns: "1", rpm: "60", mm: "5" });
  check("speed", CHIP, 60, "rpm", { int: "1678", pulses: "51200", full: "200", turns: "1", rpm: "60", mm: "5" });
});

test("positions and accelerations", () => {
  check("position", { pulsesPerCount: 12.8 }, 180, "degrees", {
    pulses: "25600",
    counts: "2000",
    full: "100",
    turns: "0.5",
    degrees: "180",
    mm: "2.5",
  });
  check("acceleration", CHIP, 100, "int", {
    int: "100",
    pulses: "46566.13",
    full: "181.8989",
    turns: "0.9094947",
    rpm: "54.56968",
    mm: "4.547474",
  });
});

test("a register holds whole numbers within its range, and says when it does not", () => {
  const [int, pps] = units("speed", DRIVE, CHIP);
  assert.ok(int && pps);
  const [there] = convert(100_000, pps, [int]);
  assert.deepEqual([there?.shown, there?.fits], [2047, false]);
  const [back] = convert(-62_468, pps, [int]);
  assert.deepEqual([back?.shown, back?.fits], [-2047, true]);
});

test("units without a meaning are not offered", () => {
  const ids = units("speed", { fullSteps: 200, microsteps: 256, mmPerTurn: 0 }, {}).map(({ id }) => id);
  assert.ok(!ids.includes("mm"));
});

test("numbers are short and plain", () => {
  assert.deepEqual([1 / 3, 1e15, 0, -2.5, NaN, 1e-9].map(readable), ["0.3333333", "1e+15", "0", "-2.5", "–", "1e-9"]);
});
