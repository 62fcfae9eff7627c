import assert from "node:assert/strict";
import { test } from "node:test";
import { History, MAX_LINES } from "./history.ts";

test("up and down, and back to what was being typed", () => {
  const history = new History(["PX", "EX"]);
  assert.equal(history.older("J"), "EX");
  assert.equal(history.older("EX"), "PX");
  assert.equal(history.older("PX"), null);
  assert.equal(history.newer(), "EX");
  assert.equal(history.newer(), "J");
  assert.equal(history.newer(), null);
});

test("a line that was sent is the newest, once", () => {
  const history = new History();
  for (const line of ["A", "A", "", "B"]) history.add(line);
  assert.deepEqual(history.lines, ["A", "B"]);
  assert.equal(history.older(""), "B");
  history.add("C");
  assert.equal(history.older(""), "C");
});

test("it does not grow without end", () => {
  const history = new History();
  for (let n = 0; n <= MAX_LINES; n += 1) history.add(`X${n}`);
  assert.equal(history.lines.length, MAX_LINES);
  assert.equal(history.lines[0], "X1");
});
