import assert from "node:assert/strict";
import { test } from "node:test";
import { addressOf, breakable, lineAt } from "./lines.ts";

// Line 3 compiles to two addresses, line 4 is a comment, and line 7's code stands before line 6's.
const LINES = [[0, 1], [1, 3], [2, 3], [4, 5], [9, 6], [7, 7]] as const;

test("an address is in the line that begins last before it", () => {
  const found = [0, 1, 2, 3, 4, 6, 7, 8, 9, 50].map((address) => lineAt(LINES, address));
  assert.deepEqual(found, [1, 3, 3, 3, 5, 5, 7, 7, 6, 6]);
  assert.equal(lineAt([[5, 2]], 4), null);
  assert.equal(lineAt([], 0), null);
});

test("a line begins at its first address", () => {
  assert.deepEqual([1, 2, 3, 6].map((line) => addressOf(LINES, line)), [0, null, 1, 9]);
});

test("a breakpoint moves to the next line with code", () => {
  assert.deepEqual([1, 2, 4, 7, 8].map((line) => breakable(LINES, line)), [1, 3, 5, 7, null]);
});
