// The tools: units, a move before it is made, homing step by step, the ratio of a closed loop, tuning.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Server, look, number, picture, until, withBrowser } from "./bench.ts";

withBrowser();
let server: Server;
before(async () => {
  server = await Server.start();
});
after(() => server.stop());

test("units of a Trinamic: internal, pulses, turns", async () => {
  await look(server, "#/pd42-1140/tools", async (page) => {
    const speed = page.getByRole("region", { name: "speed", exact: true });
    const internal = speed.getByRole("textbox", { name: /int/i }).first();
    // 16 MHz · 1000 / (2^2 · 2048 · 32) pulses a second (manual, section 6.1).
    await internal.fill("1000");
    const shown = async () => {
      const fields = await speed.getByRole("textbox").all();
      return Promise.all(fields.map(async (field) => Number((await field.inputValue()).replace(/[\s\u2009]/g, ""))));
    };
    await until("61035 pps", shown, (values) => values.some((value) => Math.abs(value - 61035.16) < 1));
  });
});

test("a move is shown before it is made, and takes the time that was shown", async () => {
  await look(server, "#/pmx-2ed/tools", async (page) => {
    await server.ask("POST", "/devices/pmx-2ed/act", { do: "power", axis: "X", on: true });
    await page.getByRole("button", { name: "Motion profile" }).click();
    const move = page.getByRole("region", { name: "Move", exact: true });
    await move.getByRole("textbox").first().fill("1500");
    const profile = page.getByRole("region", { name: "Profile" });
    // 300 ms from 100 to 1,000 pps and back take 330 pulses; the others go at 1,000 pps.
    const seconds = async () => Number(/Time\s+([\d.]+)/.exec(await profile.innerText())?.[1]);
    await until("1.77 s", seconds, (time) => Math.abs(time - 1.77) < 0.01);
    await picture(page, "tools");
    await page.getByRole("button", { name: "Make this move" }).click();
    const at = async () =>
      (await server.ask<{ axes: { X: { position: number } } }>("GET", "/devices/pmx-2ed")).axes.X.position;
    await until("it was made", at, (position) => position === 1500);
  });
});

test("homing step by step", async () => {
  await look(server, "#/cmd-4cr/tools", async (page) => {
    await page.getByRole("button", { name: "Homing", exact: true }).click();
    const before = page.getByRole("region", { name: "Before it goes" });
    await before.getByRole("button", { name: "Power on" }).click();
    await before.getByText("The motor has power.").waitFor();
    // From a place from which the search comes to the switch.
    await server.ask("POST", "/devices/cmd-4cr/act", { do: "move", targets: { X: 800 }, relative: false });
    const go = page.getByRole("region", { name: "Go", exact: true });
    await go.getByText("800").waitFor();
    await before.getByText("The axis rests.").waitFor();
    await go.getByRole("button", { name: /^Home X by/ }).click();
    await go.locator(".badge.ok", { hasText: /^home$/ }).waitFor();
  });
});

test("the ratio of StepNLoop is measured", async () => {
  await look(server, "#/pmx-2ed/tools", async (page) => {
    await page.getByRole("button", { name: "StepNLoop ratio" }).click();
    const ratio = page.getByRole("region", { name: "StepNLoop ratio" });
    await ratio.getByRole("textbox").first().fill("400");
    await ratio.getByRole("textbox").first().press("Tab");
    const power = ratio.getByRole("button", { name: "Power on" });
    await ratio.getByText(/Now: SLX=0/).waitFor();
    if (await power.isVisible()) await power.click();
    await ratio.getByRole("button", { name: "Move and measure" }).click();
    const found = ratio.getByRole("status").locator(".large");
    await found.waitFor({ timeout: 60_000 });
    assert.equal(await found.innerText(), "1.000");
  });
});

test("load, StallGuard and CoolStep", async () => {
  await look(server, "#/pd42-1140/tools", async (page) => {
    await page.getByRole("button", { name: "StallGuard & CoolStep" }).click();
    const load = page.getByRole("region", { name: "Load", exact: true });
    await load.getByRole("button", { name: "Turn ▶" }).click();
    const value = load.getByLabel("Load value", { exact: true });
    const free = await until("a load value", () => number(value), (shown) => shown > 0);
    await server.ask("PUT", "/devices/pd42-1140/axes/0/load", 0.5);
    await until("less under load", () => number(value), (shown) => shown < free);
    await page.getByRole("region", { name: "StallGuard2" }).getByRole("slider").first().waitFor();
    await page.getByRole("region", { name: "CoolStep" }).getByRole("slider").first().waitFor();
    await load.getByRole("button", { name: "Stop" }).click();
  });
});
