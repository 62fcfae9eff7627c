import assert from "node:assert/strict";
import { test } from "node:test";
import { coolStepRange, current32, judge, sum, thresholds } from "./load.ts";

test("thresholds of CoolStep", () => {
  assert.equal(thresholds(0, 15), null);
  assert.deepEqual(thresholds(1, 0), [32, 64]);
  assert.deepEqual(thresholds(15, 15), [480, 992]);
});

test("currents are in steps of eight, and CoolStep goes down to a half or a quarter", () => {
  assert.deepEqual([0, 7, 8, 255].map(current32), [1, 1, 2, 32]);
  assert.deepEqual(coolStepRange(255, 0), [16, 32]);
  assert.deepEqual(coolStepRange(255, 1), [8, 32]);
  assert.deepEqual(coolStepRange(0, 1), [1, 1]);
});

test("the threshold is judged by readings with and without load", () => {
  const check = (free: number[], loaded: number[], words: RegExp) => assert.match(judge(sum(free), sum(loaded)), words);
  check([], [], /without load/);
  check([1023, 900], [], /lower the threshold/);
  check([0, 10], [], /raise the threshold/);
  check([500, 520], [], /brake the motor/);
  check([500, 520], [0, 12], /counts as a stall/);
  check([500, 520], [600, 610], /does not fall/);
  check([500, 520], [300, 320], /There is room/);
  check([500, 520], [20, 60], /fits/);
});
