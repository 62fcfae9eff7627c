import assert from "node:assert/strict";
import { test } from "node:test";
import { ratio } from "./stepnloop.ts";

test("a thousand pulses and what the encoder counted (7.17)", () => {
  assert.deepEqual(ratio([{ pulses: 1000, counts: 400 }]), { ok: true, ratio: 2.5, exact: 2.5, spread: 0 });
});

test("several moves are more exact than one", () => {
  const made = ratio([
    { pulses: 1000, counts: 300 },
    { pulses: -1000, counts: -299 },
    { pulses: 0, counts: 5 },
  ]);
  assert.ok(made.ok);
  assert.equal(made.ratio, 3.339);
  assert.equal(made.spread.toFixed(4), "0.0111");
});

test("no ratio at all says why", () => {
  const check = (pulses: number, counts: number, reason: string) => {
    const made = ratio([{ pulses, counts }]);
    assert.ok(!made.ok);
    assert.equal(made.reason, reason);
  };
  check(1000, 0, "no encoder");
  check(0, 0, "no encoder");
  check(1000, -400, "wrong way");
  check(1_000_000, 1, "out of range");
  check(1, 1_000_000, "out of range");
});
