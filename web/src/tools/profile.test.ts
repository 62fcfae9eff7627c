import assert from "node:assert/strict";
import { test } from "node:test";
import { at, points, profile, type Move } from "./profile.ts";

const MOVE: Move = {
  pulses: 10_000,
  startPps: 100,
  stopPps: 100,
  topPps: 1000,
  acceleration: 3000,
  deceleration: 3000,
  sCurve: false,
};

function close(actual: number, expected: number, within = 1e-6) {
  assert.ok(Math.abs(actual - expected) <= within * Math.max(Math.abs(expected), 1), `${actual} is not ${expected}`);
}

/** What must hold of any move: it begins and ends as told, and its way is the integral of its speed. */
function sound(move: Move) {
  const made = profile(move);
  const list = points(made, 4001);
  const first = list[0];
  const last = list.at(-1);
  assert.ok(first && last);
  close(first.pulses, 0);
  close(last.pulses, Math.abs(move.pulses));
  let way = 0;
  for (const [n, point] of list.entries()) {
    const before = list[n - 1];
    if (before) way += ((point.pps + before.pps) / 2) * (point.seconds - before.seconds);
    assert.ok(point.pps <= move.topPps + 1e-9);
    close(way, point.pulses, 1e-3);
  }
  return made;
}

test("a trapezoid", () => {
  const made = sound(MOVE);
  // 0.3 s to 1000 pps over 165 pulses, and back.
  close(made.up.seconds, 0.3);
  close(made.cruiseSeconds, 9.67);
  close(made.seconds, 10.27);
  assert.ok(made.reached);
  close(at(made, 0.15).pps, 550);
  close(at(made, 5).pps, 1000);
});

test("a short move is a triangle, its peak in the middle", () => {
  const made = sound({ ...MOVE, pulses: -200 });
  assert.ok(!made.reached);
  // v² = 100² + 2·3000·100.
  close(made.peakPps, Math.sqrt(610_000), 1e-9);
  close(made.cruiseSeconds, 0, 1e-6);
});

test("an S takes as long as the straight ramp, a short one keeps its jerk", () => {
  close(sound({ ...MOVE, sCurve: true }).seconds, profile(MOVE).seconds);
  const short = sound({ ...MOVE, sCurve: true, pulses: 200 });
  assert.ok(!short.reached);
  close(short.up.seconds, 0.3 * Math.sqrt((short.peakPps - 100) / 900));
});

test("ramps that differ, and speeds at both ends that differ", () => {
  sound({ ...MOVE, deceleration: 500 });
  sound({ ...MOVE, stopPps: 900, pulses: 300 });
  sound({ ...MOVE, startPps: 1000, stopPps: 1000 });
  sound({ ...MOVE, startPps: 5000, stopPps: 5000 });
});

test("nothing to do, and nothing to do it with", () => {
  assert.equal(profile({ ...MOVE, pulses: 0 }).pulses, 0);
  close(profile({ ...MOVE, pulses: 0 }).seconds, 0);
  assert.equal(profile({ ...MOVE, topPps: 0 }).seconds, 0);
});
