import assert from "node:assert/strict";
import { test } from "node:test";
import {
  accelerationRange,
  accelerationUnit,
  bestDivisors,
  externalPrescaler,
  sensostepPrescaler,
  speedUnit,
} from "./tmc429.ts";

test("the manual's examples of 6.1", () => {
  assert.equal((1678 * speedUnit(3)).toFixed(1), "51208.5");
  assert.equal((100 * accelerationUnit({ ramp: 7, pulse: 3 })).toFixed(0), "46566");
});

test("positioning ramps have limits where the divisors differ", () => {
  const check = (ramp: number, pulse: number, range: [number, number]) =>
    assert.deepEqual(accelerationRange({ ramp, pulse }), range, `${ramp} ${pulse}`);
  check(7, 3, [8, 2047]);
  check(3, 2, [1, 2047]);
  check(0, 2, [1, 1023]);
  check(0, 13, [1, 1]);
  check(13, 0, [2047, 2047]);
});

test("the best divisors are the largest that still reach the speed", () => {
  assert.deepEqual(bestDivisors(51_200, 46_566), { pulse: 3, ramp: 11 });
  assert.deepEqual(bestDivisors(1e9, 1e12), { pulse: 0, ramp: 0 });
  assert.deepEqual(bestDivisors(1, 1), { pulse: 13, ramp: 13 });
  for (const pps of [100, 5000, 77_777, 400_000]) {
    const { pulse } = bestDivisors(pps, 1);
    const full = speedUnit(pulse) * 2047;
    assert.ok(full >= pps && (pulse === 13 || full < 2 * pps), `${pps}: ${pulse}`);
  }
});

test("prescalers are those of tables 21 and 22", () => {
  const table = [[256, 25600], [128, 12800], [64, 6400], [32, 3200], [16, 1600], [8, 800], [4, 400]] as const;
  for (const [microsteps, prescaler] of table) assert.equal(sensostepPrescaler(microsteps, 200), prescaler);
  assert.equal(externalPrescaler(256, 200, 51_200), 256);
  assert.equal(externalPrescaler(256, 200, 4000), 3277);
});
