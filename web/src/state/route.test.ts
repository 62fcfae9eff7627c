import assert from "node:assert/strict";
import { test } from "node:test";
import { parseRoute, routeTo } from "./route.ts";

test("addresses and back", () => {
  const check = (hash: string, device: string | null, tab: string | null) => {
    assert.deepEqual(parseRoute(hash), { device, tab }, hash);
  };
  check("", null, null);
  check("#/", null, null);
  check("#/stage", "stage", null);
  check("#/stage/chart", "stage", "chart");
  check("#/a%2Fb%20c/io", "a/b c", "io");
  check("#/%/io", null, "io");
  assert.equal(routeTo(null), "#/");
  assert.equal(routeTo("a/b c", "io"), "#/a%2Fb%20c/io");
});
