// The overview: what there is, and adding to it.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Server, look, picture, withBrowser } from "./bench.ts";

withBrowser();
let server: Server;
let other: Server;
before(async () => {
  server = await Server.start();
  // What is connected to as a real controller: its wire is all that is known of it.
  other = await Server.start({ devices: ["pmx-2ed=far@tcp:127.0.0.1:0"] });
});
after(async () => {
  await server.stop();
  await other.stop();
});

const BENCH = `[[device]]
model = "cmd-4cr"
name = "added"
listen = ["tcp:127.0.0.1:0"]
`;

test("every controller with its axes and their state", async () => {
  await look(server, "#/", async (page) => {
    for (const [name, axes] of [["pd42-1140", 1], ["pmx-2ed", 2], ["cmd-4cr", 4]] as const) {
      const rows = page.getByRole("table", { name: `Axes of ${name}` }).getByRole("row");
      await rows.nth(axes).waitFor();
      assert.equal(await rows.count(), axes + 1);
    }
    await picture(page, "overview");
  });
});

test("a bench file adds controllers, and its errors are shown with their line", async () => {
  await look(server, "#/", async (page, window) => {
    await page.getByRole("button", { name: "Add virtual…" }).click();
    const text = page.getByLabel("Bench file (TOML)");
    await text.fill(BENCH.replace("cmd-4cr", "cmd-5"));
    const add = page.getByRole("button", { name: "Add", exact: true });
    await add.click();
    await page.getByRole("alert").filter({ hasText: "cmd-5" }).waitFor();
    assert.match(await page.getByRole("alert").filter({ hasText: "cmd-5" }).innerText(), /\b2\b/);
    await text.fill(BENCH);
    await add.click();
    await page.getByRole("link", { name: "added", exact: true }).waitFor();
    await page.getByRole("button", { name: "Remove added" }).click();
    await page.getByRole("button", { name: "Remove", exact: true }).click();
    await page.getByRole("link", { name: "added", exact: true }).waitFor({ state: "detached" });
    // The refusal is one that the browser takes down too.
    window.complaints.length = 0;
  });
});

test("a bus is searched, and a real controller connected and driven", async () => {
  const [far] = await other.ask<{ endpoints: string[] }[]>("GET", "/devices");
  const host = far!.endpoints[0]!.replace("tcp:", "");
  await look(server, "#/", async (page) => {
    await page.getByRole("button", { name: "Connect real…" }).click();
    await page.getByRole("textbox", { name: "Name" }).fill("machine");
    await page.getByRole("combobox", { name: "Model" }).selectOption("pmx-2ed");
    await page.getByRole("radio", { name: "TCP" }).check();
    await page.getByLabel("Host and port").fill(host);
    await page.getByRole("button", { name: "Search the bus" }).click();
    await page.getByRole("table", { name: "What answered" }).getByText("pmx-2ed").waitFor({ timeout: 60_000 });
    await page.getByRole("button", { name: "Connect", exact: true }).click();
    await page.getByRole("link", { name: "machine", exact: true }).click();
    const axis = page.getByRole("region", { name: "Axis X", exact: true });
    await axis.getByRole("button", { name: "motor off" }).click();
    await axis.getByRole("button", { name: "motor on" }).waitFor();
    await page.getByLabel(/^Target of axis X/).fill("300");
    await page.getByRole("button", { name: "Move to" }).click();
    await axis.locator("[data-role=position]").getByText("300").waitFor();
    const state = await other.ask<{ axes: { X: { position: number } } }>("GET", "/devices/far");
    assert.equal(state.axes.X.position, 300);
  });
});
