// The terminal, and what goes over the wire.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { Server, look, picture, until, withBrowser } from "./bench.ts";

withBrowser();
let server: Server;
before(async () => {
  server = await Server.start();
});
after(() => server.stop());

test("commands of a Performax with replies, history, completion and help", async () => {
  await look(server, "#/pmx-2ed/terminal", async (page) => {
    const line = page.getByLabel("Command", { exact: true });
    const log = page.locator("pt-terminal").getByRole("log");
    await line.fill("ID");
    await line.press("Enter");
    await log.getByText("PERFORMAX-2ED-SA").waitFor();
    await line.fill("V7=123");
    await line.press("Enter");
    await line.fill("V7");
    await line.press("Enter");
    await log.getByText("123", { exact: true }).waitFor();
    await line.fill("XYZ");
    await line.press("Enter");
    await log.getByText("?XYZ").waitFor();
    await line.press("ArrowUp");
    assert.equal(await line.inputValue(), "XYZ");
    await line.press("ArrowUp");
    assert.equal(await line.inputValue(), "V7");

    await line.fill("HSP");
    await page.locator("pt-terminal").getByText("High speed").first().waitFor();
    await line.press("Tab");
    assert.match(await line.inputValue(), /^HSPD/);
    await picture(page, "terminal");
  });
});

test("TMCL mnemonics in direct mode, and every frame in hex and in words", async () => {
  await look(server, "#/pd42-1140/terminal", async (page) => {
    const line = page.getByLabel("Command", { exact: true });
    const log = page.locator("pt-terminal").getByRole("log");
    await line.fill("MVP ABS, 0, 5000");
    await line.press("Enter");
    const position = async () =>
      (await server.ask<{ axes: Record<string, { position: number }> }>("GET", "/devices/pd42-1140")).axes["0"]!.position;
    await until("it is there", position, (at) => at === 5000);
    await line.fill("GAP 1, 0");
    await line.press("Enter");
    await log.getByText(/\b5000\b/).first().waitFor();
    await line.fill("SAP 4, 0, 9999");
    await line.press("Enter");
    await log.getByText(/invalid value/i).first().waitFor();

    const traffic = page.getByRole("region", { name: "Lines of traffic" });
    await page.getByLabel("Filter").fill("MVP");
    await traffic.getByText("01 04 00 00 00 00 13 88 A0").waitFor();
    await traffic.getByText(/MVP ABS/).first().waitFor();
  });
});

test("traffic is saved as it was filtered", async () => {
  await look(server, "#/pmx-2ed/terminal", async (page) => {
    const line = page.getByLabel("Command", { exact: true });
    await line.fill("V9=4711");
    await line.press("Enter");
    const traffic = page.getByRole("region", { name: "Traffic", exact: true });
    await traffic.getByLabel("Filter").fill("V9=");
    await traffic.getByRole("cell", { name: /V9=4711/ }).waitFor();
    // What the page asks to see how things are is left out, unless one wants to see it.
    await traffic.getByLabel("Filter").fill("");
    const polls = traffic.getByRole("cell", { name: /MST$/ });
    await traffic.getByRole("cell", { name: /V9=4711/ }).waitFor();
    assert.equal(await polls.count(), 0);
    await traffic.getByLabel("polling").check();
    await polls.first().waitFor();
    await traffic.getByLabel("polling").uncheck();
    await traffic.getByLabel("Filter").fill("V9=");
    const saved = page.waitForEvent("download");
    await traffic.getByRole("button", { name: "Export" }).click();
    const file = await saved;
    assert.equal(file.suggestedFilename(), "pmx-2ed-traffic.csv");
    const rows = (await readFile(await file.path(), "utf8")).trim().split("\r\n");
    assert.equal(rows.length, 2);
    assert.equal(rows[0], "seconds,direction,hex,text");
    // 56 39 3D 34 37 31 31 is V9=4711.
    assert.match(rows[1]!, /^\d+\.\d+,out,.*56 39 3D 34 37 31 31.*V9=4711/);
  });
});
