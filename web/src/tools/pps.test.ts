import assert from "node:assert/strict";
import { test } from "node:test";
import type { SpeedWindow } from "../api/contract.ts";
import { move, rampRange, windowOf, type Settings } from "./pps.ts";
import { profile } from "./profile.ts";

/** Rows of table A.0 of the PMX-2ED-SA manual, and one with a magnification as in table B-46 of the CMD-4CR manual. */
const WINDOWS: SpeedWindow[] = [
  { number: 1, from_pps: 1, to_pps: 16_000, least_low_pps: 1, step_pps: 1, least_ms: 1, delta: 300 },
  { number: 2, from_pps: 16_000, to_pps: 32_000, least_low_pps: 2, step_pps: 1, least_ms: 1, delta: 775 },
  { number: 7, from_pps: 815_000, to_pps: 1_600_000, least_low_pps: 100, step_pps: 100, least_ms: 1, delta: 38_400 },
];

const SETTINGS: Settings = {
  highPps: 10_000,
  lowPps: 1000,
  accelerationMs: 300,
  decelerationMs: 300,
  sCurve: false,
  window: 0,
  pulsesPerCount: null,
};

test("ramps have the ranges of the manual's examples (A.1)", () => {
  const check = (low: number, high: number, range: [number, number]) => {
    const window = windowOf(WINDOWS, high);
    assert.ok(window);
    assert.deepEqual(rampRange(window, low, high), range);
  };
  check(10_000, 20_000, [1, 12_903]);
  check(9000, 900_000, [1, 23_203]);
  check(500, 400, [1, 1]);
});

test("what is out of range is brought into it and said", () => {
  const slow = move({ ...SETTINGS, accelerationMs: 100_000, decelerationMs: 0 }, 10_000_000, WINDOWS);
  assert.deepEqual([slow.accelerationMs, slow.decelerationMs], [30_000, 1]);
  assert.equal(slow.notes.length, 2);
  assert.equal(move({ ...SETTINGS, highPps: 900_050, lowPps: 1 }, 1, WINDOWS).move.topPps, 900_000);
  assert.equal(move({ ...SETTINGS, highPps: 900_050, lowPps: 1 }, 1, WINDOWS).move.startPps, 100);
  assert.equal(move({ ...SETTINGS, window: 2, lowPps: 1 }, 1, WINDOWS).move.startPps, 2);
});

test("a short move slows down as it sped up (A.2)", () => {
  const check = (pulses: number, times: [number, number], expected: [number, number]) => {
    const [accelerationMs, decelerationMs] = times;
    const settings = { ...SETTINGS, highPps: 9000, accelerationMs, decelerationMs };
    const made = move(settings, pulses, WINDOWS);
    assert.deepEqual([made.accelerationMs, made.decelerationMs], expected);
  };
  check(1000, [50, 100], [50, 100]);
  check(999, [50, 100], [50, 50]);
  check(-1000, [100, 50], [100, 50]);
  check(999, [100, 50], [100, 100]);
});

test("in a closed loop everything is in counts", () => {
  const open = move(SETTINGS, 10_000, WINDOWS);
  const closed = move({ ...SETTINGS, highPps: 4000, lowPps: 400, pulsesPerCount: 2.5 }, 4000, WINDOWS);
  assert.deepEqual(closed, open);
  assert.equal(profile(open.move).reached, true);
});
