import assert from "node:assert/strict";
import { test } from "node:test";
import { CAPACITY, SampleRing } from "./samples.ts";

function batch(from: number, count: number) {
  const seconds = Array.from({ length: count }, (_, n) => (from + n) / 100);
  const position = Array.from({ length: count }, (_, n) => from + n);
  return { seconds, axes: { X: { position, encoder: position, speed: position, load: null, delta: null } } };
}

test("the newest samples are one piece, oldest first, whatever has been thrown away", () => {
  const check = (added: number, expected: number) => {
    const ring = new SampleRing();
    for (let n = 1; n <= added; n += 100) ring.add(batch(n, Math.min(100, added - n + 1)));
    assert.equal(ring.length, expected);
    const values = ring.values("X", "position");
    assert.equal(values.length, expected);
    values.forEach((value, n) => assert.equal(value, added - expected + 1 + n));
    assert.equal(ring.time().at(-1), added / 100);
    assert.equal(ring.last, added / 100);
  };
  check(1, 1);
  check(250, 250);
  check(CAPACITY, CAPACITY);
  check(CAPACITY + 1, CAPACITY);
  check(3 * CAPACITY + 37, CAPACITY);
});

test("a quantity that a device does not have has no curve", () => {
  const ring = new SampleRing();
  ring.add(batch(1, 2));
  assert.equal(ring.has("X", "position"), true);
  assert.equal(ring.has("X", "load"), false);
  assert.equal(ring.has("Y", "position"), false);
});

test("time that begins anew empties the ring, a sample that comes twice does not", () => {
  const ring = new SampleRing();
  ring.add(batch(1000, 50));
  ring.add(batch(1049, 2));
  assert.equal(ring.length, 51);
  ring.add(batch(1, 3));
  assert.equal(ring.length, 3);
  assert.deepEqual([...ring.values("X", "speed")], [1, 2, 3]);
});
