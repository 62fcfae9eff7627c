// Every parameter of the table.

import assert from "node:assert/strict";
import { readFile, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import type { Page } from "playwright-core";
import { Server, look, picture, until, withBrowser } from "./bench.ts";

withBrowser();
let server: Server;
before(async () => {
  server = await Server.start();
});
after(() => server.stop());

const row = (page: Page, id: string) => page.getByRole("row").filter({ has: page.getByText(id, { exact: true }) });
const field = (page: Page, id: string) => row(page, id).getByRole("textbox");
const say = async (device: string, line: string) => {
  const { reply, text } = await server.ask<{ reply: string; text: string }>("POST", `/devices/${device}/terminal`, { line });
  return text || reply;
};

async function ready(page: Page, id: string): Promise<void> {
  await until(`${id} is read`, () => field(page, id).inputValue(), (value) => value !== "");
}

test("a parameter is changed, stored, and there after the power was off", async () => {
  await look(server, "#/pd42-1140/parameters", async (page) => {
    await page.getByLabel("Search parameters").fill("maximum");
    await ready(page, "AP4.0");
    assert.equal(await field(page, "AP4.0").inputValue(), "1000");
    await field(page, "AP4.0").fill("99999");
    await row(page, "AP4.0").getByRole("alert").waitFor();
    await field(page, "AP4.0").fill("777");
    await page.getByRole("button", { name: /^Write/ }).click();
    await row(page, "AP4.0").getByText("not default").waitFor();
    await row(page, "AP4.0").getByText("not stored").waitFor();
    await picture(page, "parameters");
    await page.getByRole("button", { name: /^Store/ }).click();
    await row(page, "AP4.0").getByText("not stored").waitFor({ state: "detached" });
    await server.ask("POST", "/devices/pd42-1140/power-cycle");
    await until("777 is still there", () => say("pd42-1140", "GAP 4, 0"), (text) => /\b777\b/.test(text));

    await page.getByRole("button", { name: "Factory settings" }).click();
    await page.getByRole("button", { name: "Restore", exact: true }).click();
    await until("1000 again", () => say("pd42-1140", "GAP 4, 0"), (text) => /\b1000\b/.test(text));
  });
});

test("parameters are searched by number, name and words", async () => {
  await look(server, "#/cmd-4cr/parameters", async (page) => {
    const rows = page.locator("pt-parameters tbody tr");
    const all = await until("all are listed", () => rows.count(), (count) => count > 150);
    await page.getByLabel("Search parameters").fill("joystick");
    const few = await until("fewer", () => rows.count(), (count) => count < all && count > 0);
    assert.ok(few < 60, `${few}`);
    await page.getByLabel("Search parameters").fill("HSPDX");
    await until("one", () => rows.count(), (count) => count >= 1 && count < 4);
  });
});

test("parameters go to a file, and come back after a look at what would change", async () => {
  await look(server, "#/pmx-2ed/parameters", async (page) => {
    await page.getByLabel("Search parameters").fill("HSPDX");
    await ready(page, "HSPDX");
    const download = page.waitForEvent("download");
    await page.getByRole("button", { name: "Save to file" }).click();
    const saved = await readFile(await (await download).path(), "utf8");
    const file = JSON.parse(saved) as { model: string; values?: Record<string, unknown> };
    assert.equal(file.model, "pmx-2ed");
    const changed = join(tmpdir(), `pulsetrain-parameters-${process.pid}.json`);
    const before = await say("pmx-2ed", "HSPDX");
    await writeFile(changed, saved.replace(/("HSPDX": ?)\d+/, "$14321"));
    const chooser = page.waitForEvent("filechooser");
    await page.getByRole("button", { name: "Load from file" }).click();
    await (await chooser).setFiles(changed);
    await page.locator(".diff").getByText(/4.?321/).first().waitFor();
    assert.equal(await say("pmx-2ed", "HSPDX"), before, "nothing is written before one has agreed");
    await page.getByRole("button", { name: "Write 1 change" }).click();
    await until("it is written", () => say("pmx-2ed", "HSPDX"), (text) => text === "4321");
  });
});

test("the setup of a Performax: polarity, start-up, homing, joystick, StepNLoop, name", async () => {
  await look(server, "#/pmx-2ed/parameters", async (page) => {
    for (const id of ["POLX", "DOBOOT", "EOBOOT", "SLOAD", "HCAX", "LCAX", "RZ", "JL1", "SLRX", "SLEX", "DN", "IERR", "EDEC", "DB"]) {
      await page.getByLabel("Search parameters").fill(id);
      await row(page, id).first().waitFor();
    }
    await page.getByLabel("Search parameters").fill("DN");
    await ready(page, "DN");
    await field(page, "DN").fill("2ED07");
    await page.getByRole("button", { name: /^Write/ }).click();
    await until("the name is written", () => say("pmx-2ed", "DN"), (text) => text === "2ED07");
  });
});
