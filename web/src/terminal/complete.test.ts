import assert from "node:assert/strict";
import { test } from "node:test";
import type { CommandInfo } from "../api/contract.ts";
import { about, proposals } from "./complete.ts";

const COMMANDS = ["HSPD", "H[axis]", "HSPD[axis]", "HL[axis]", "J[axis]", "HSPD"].map((syntax): CommandInfo => {
  const name = syntax.replace(/\[.*/, "");
  return { name, syntax, text: "", example: "", section: "", unit: "" };
});

function check(find: typeof about, line: string, expected: string[]) {
  assert.deepEqual(find(COMMANDS, line).map(({ syntax }) => syntax), expected, line);
}

test("a beginning proposes what it may become, short ones first", () => {
  check(proposals, "h", ["H[axis]", "HL[axis]", "HSPD", "HSPD[axis]"]);
  check(proposals, "HS", ["HSPD", "HSPD[axis]"]);
  check(proposals, "", []);
  check(proposals, "HSPD=", []);
  check(proposals, "Q", []);
});

test("a line is about the longest name in it", () => {
  check(about, "HSPDX=2000", ["HSPD", "HSPD[axis]", "HSPD"]);
  check(about, "HX+", ["H[axis]"]);
  check(about, "HLX-", ["HL[axis]"]);
  check(about, "1000", []);
});
