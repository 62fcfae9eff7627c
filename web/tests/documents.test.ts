// docs/page.md: each test that it names is there, and each is named; its pictures are there too.

import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { readFile, readdir } from "node:fs/promises";
import { test } from "node:test";

const PAGE = "docs/page.md";
const TESTS = "web/tests";

test("every function in the documents has its test", async () => {
  const page = await readFile(PAGE, "utf8");
  const rows = page.split("\n").filter((line) => line.startsWith("| ") && line.endsWith("` |"));
  const named = new Set(rows.flatMap((row) => [...row.split("|").at(-2)!.matchAll(/`([^`]+)`/g)].map(([, name]) => name!)));
  const present = new Set<string>();
  for (const file of await readdir(TESTS)) {
    if (!file.endsWith(".test.ts") || file === "documents.test.ts") continue;
    for (const [, name] of (await readFile(`${TESTS}/${file}`, "utf8")).matchAll(/^test\("([^"]+)"/gm)) present.add(name!);
  }
  assert.ok(present.size > 25, `${present.size} tests`);
  assert.deepEqual([...named].sort(), [...present].sort());
});

test("every picture of the page is there", async () => {
  const page = await readFile(PAGE, "utf8");
  const pictures = [...page.matchAll(/!\[[^\]]+\]\(([^)]+)\)/g)].map(([, path]) => path!);
  assert.equal(pictures.length, 9);
  for (const path of pictures) assert.ok(existsSync(`docs/${path}`), path);
});
