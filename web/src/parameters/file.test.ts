import assert from "node:assert/strict";
import { test } from "node:test";
import type { Catalog, ParameterInfo } from "../api/contract.ts";
import { changes, read, write } from "./file.ts";

const base = { group: "", axis: null, symbol: "", unit: "", text: "", section: "", default: 0, decimals: 0 };
const info = (id: string, writable = true): ParameterInfo => {
  return { ...base, id, name: id, low: 0, high: 100, readable: true, writable, stored: true, is_text: id === "DN",
    role: null, is_setting: writable };
};
const CATALOG = {
  model: "pmx-2ed",
  parameters: [info("ACC"), info("PS", false), info("DN"), info("DEC")],
} as unknown as Catalog;

const VALUES = { DEC: 7, ACC: 5, PS: 3, DN: "2ED00" };
const FILE = write(CATALOG, "stage", VALUES, new Date(0));

function fails(text: string, words: RegExp) {
  const file = read(CATALOG, text);
  assert.ok(typeof file === "string");
  assert.match(file, words);
}

test("what was saved comes back, in the order of the table and without what cannot be written", () => {
  const file = read(CATALOG, FILE);
  assert.ok(typeof file !== "string");
  assert.deepEqual([...file.values].map(([{ id }, value]) => [id, value]), [["ACC", 5], ["DN", "2ED00"], ["DEC", 7]]);
  assert.deepEqual([file.device, file.date, file.problems], ["stage", "1970-01-01T00:00:00.000Z", []]);
});

test("files that are none, or another model's", () => {
  fails("{", /not JSON/);
  fails("[]", /no parameters/);
  fails(FILE.replace("pmx-2ed", "cmd-4cr"), /of a cmd-4cr/);
  fails(FILE.replace('"version": 1', '"version": 2'), /newer/);
  fails('{"format":"pulsetrain parameters","version":1,"model":"pmx-2ed"}', /no parameters/);
});

test("single values that are wrong are told and left out", () => {
  const wrong = '{"ACC": 101, "PS": 3, "DN": 5, "XYZ": 1, "DEC": null}';
  const file = read(CATALOG, `{"format":"pulsetrain parameters","version":1,"model":"pmx-2ed","parameters":${wrong}}`);
  assert.ok(typeof file !== "string");
  assert.equal(file.values.size, 0);
  assert.deepEqual(file.problems, [
    "ACC: At most 100.",
    "PS: Not a setting.",
    "DN: This is text.",
    "XYZ: There is no such parameter.",
    "DEC: Neither a number nor text.",
  ]);
});

test("only what differs is written", () => {
  const file = read(CATALOG, FILE);
  assert.ok(typeof file !== "string");
  const found = changes(CATALOG, file.values, { ...VALUES, ACC: 6 });
  assert.deepEqual(found.map(({ info, from, to }) => [info.id, from, to]), [["ACC", 6, 5]]);
  assert.equal(changes(CATALOG, file.values, {}).length, 3);
});
