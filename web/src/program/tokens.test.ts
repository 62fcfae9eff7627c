import assert from "node:assert/strict";
import { test } from "node:test";
import { decode, type Legend } from "./tokens.ts";

const LEGEND: Legend = { tokenTypes: ["keyword", "number", "comment"], tokenModifiers: ["definition", "readonly"] };

function check(data: number[], expected: string[]) {
  const shown = decode(data, LEGEND).map(({ line, start, length, classes }) => `${line}:${start}+${length} ${classes}`);
  assert.deepEqual(shown, expected);
}

test("tokens are relative to the one before", () => {
  check(
    [0, 0, 3, 0, 0, 0, 4, 1, 1, 0, 2, 2, 5, 2, 3],
    ["0:0+3 cm-token-keyword", "0:4+1 cm-token-number", "2:2+5 cm-token-comment cm-token-definition cm-token-readonly"],
  );
});

test("what is unknown is left out and does not move what follows", () => {
  check([1, 3, 4, 9, 0, 0, 5, 1, 1, 0], ["1:8+1 cm-token-number"]);
  check([1, 3, 0, 0, 0, 0, 5, 1, 1, 2], ["1:8+1 cm-token-number cm-token-readonly"]);
  check([0, 1, 2, 0, 0, 7, 7], ["0:1+2 cm-token-keyword"]);
  check([], []);
});
