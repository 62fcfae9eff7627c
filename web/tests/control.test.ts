// Status and control: what a builder does with a machine in front of him.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import type { Page } from "playwright-core";
import { Server, look, number, picture, until, withBrowser } from "./bench.ts";

withBrowser();
let server: Server;
before(async () => {
  server = await Server.start();
});
after(() => server.stop());

const axis = (page: Page, name: string) => page.getByRole("region", { name: `Axis ${name}`, exact: true });
const position = (page: Page, name: string) => number(axis(page, name).locator("[data-role=position]"));
const speed = (page: Page, name: string) => number(axis(page, name).locator("[data-role=speed]"));
const state = (page: Page, name: string) => axis(page, name).locator("[data-role=state]");

/** Switches the motor on where it has a switch. */
async function power(page: Page, name: string): Promise<void> {
  const motor = axis(page, name).getByRole("button", { name: /^motor/ });
  await until("the motor can be switched", () => motor.isEnabled(), (may) => may);
  if ((await motor.getAttribute("aria-pressed")) === "false") await motor.click();
  await until("the motor on", () => motor.getAttribute("aria-pressed"), (on) => on === "true");
}

async function atRest(page: Page, name: string): Promise<number> {
  await until(`${name} at rest`, () => speed(page, name), (pps) => pps === 0);
  return position(page, name);
}

async function move(page: Page, targets: Record<string, number>): Promise<void> {
  for (const [name, target] of Object.entries(targets)) {
    await page.getByLabel(new RegExp(`^(Target|Distance) of axis ${name} `)).fill(String(target));
  }
  await page.getByRole("button", { name: /^Move (to|by|.* together)$/ }).click();
}

test("jogging lasts as long as the button is held", async () => {
  await look(server, "#/pmx-2ed/control", async (page) => {
    await power(page, "X");
    const jog = axis(page, "X").getByRole("button", { name: "Jog X in positive direction while pressed" });
    await jog.hover();
    await page.mouse.down();
    await until("X moves", () => position(page, "X"), (at) => at > 100);
    await page.mouse.up();
    const stopped = await atRest(page, "X");
    await page.waitForTimeout(300);
    assert.equal(await position(page, "X"), stopped);

    // With the keyboard, and ended by the window losing its focus.
    const back = axis(page, "X").getByRole("button", { name: "Jog X in negative direction while pressed" });
    await back.focus();
    await page.keyboard.down("Space");
    await until("X moves back", () => position(page, "X"), (at) => at < stopped - 50);
    await page.evaluate(() => window.dispatchEvent(new Event("blur")));
    await atRest(page, "X");
    await page.keyboard.up("Space");
  });
});

test("a move ends at its target, and Escape stops one that is under way", async () => {
  await look(server, "#/pmx-2ed/control", async (page) => {
    await power(page, "X");
    await power(page, "Y");
    await page.getByRole("button", { name: "ABS" }).click();
    await move(page, { X: 500 });
    await until("X at 500", () => position(page, "X"), (at) => at === 500);
    await atRest(page, "X");

    await move(page, { X: 50000 });
    await until("X under way", () => speed(page, "X"), (pps) => pps > 0);
    await page.keyboard.press("Escape");
    const stopped = await atRest(page, "X");
    assert.ok(stopped > 500 && stopped < 50000, `${stopped}`);

    // The red button, from another tab.
    await move(page, { X: 50000 });
    await until("X under way again", () => speed(page, "X"), (pps) => pps > 0);
    await page.getByRole("link", { name: "Terminal" }).click();
    await page.getByRole("button", { name: "■ STOP" }).click();
    await page.getByRole("link", { name: "Control", exact: true }).click();
    assert.ok((await atRest(page, "X")) < 50000);
  });
});

test("targets are positions or distances, and several axes move together", async () => {
  await look(server, "#/cmd-4cr/control", async (page) => {
    await power(page, "X");
    await power(page, "Y");
    await page.getByRole("button", { name: "ABS" }).click();
    await page.getByRole("checkbox", { name: "Move axis Y" }).check();
    await move(page, { X: 600, Y: 300 });
    await until("X at 600", () => position(page, "X"), (at) => at === 600);
    await until("Y at 300", () => position(page, "Y"), (at) => at === 300);
    await page.getByRole("button", { name: "INC" }).click();
    await until("INC", () => page.getByRole("button", { name: "INC" }).getAttribute("aria-pressed"), (on) => on === "true");
    await move(page, { X: 100, Y: -100 });
    await until("X at 700", () => position(page, "X"), (at) => at === 700);
    await until("Y at 200", () => position(page, "Y"), (at) => at === 200);
    await picture(page, "control");
    await page.getByRole("button", { name: "Return to 0" }).click();
    await until("X back", () => position(page, "X"), (at) => at === 0);
    await until("Y back", () => position(page, "Y"), (at) => at === 0);
  });
});

test("a limit stops the axis, and its error is cleared", async () => {
  await look(server, "#/pmx-2ed/control", async (page) => {
    await power(page, "Y");
    await server.ask("PUT", "/devices/pmx-2ed/pins/+LY", true);
    const jog = axis(page, "Y").getByRole("button", { name: "Jog Y in positive direction while pressed" });
    await jog.hover();
    await page.mouse.down();
    await axis(page, "Y").getByText("⚠").waitFor();
    await page.mouse.up();
    assert.match(await axis(page, "Y").locator(".error-line").innerText(), /limit/i);
    await server.ask("DELETE", "/devices/pmx-2ed/pins/+LY");
    await axis(page, "Y").getByRole("button", { name: "Clear" }).click();
    await axis(page, "Y").getByText("no error").waitFor();
  });
});

test("the fourth axis of a CMD-4CR alone: jogged, moved, homed", async () => {
  await look(server, "#/cmd-4cr/control", async (page) => {
    await power(page, "U");
    const jog = axis(page, "U").getByRole("button", { name: "Jog U in positive direction while pressed" });
    await jog.hover();
    await page.mouse.down();
    await until("U moves", () => position(page, "U"), (at) => at > 100);
    await page.mouse.up();
    const from = await atRest(page, "U");

    await page.getByRole("checkbox", { name: "Move axis X" }).uncheck();
    await page.getByRole("checkbox", { name: "Move axis U" }).check();
    await page.getByRole("button", { name: "ABS" }).click();
    await until("ABS", () => page.getByRole("button", { name: "ABS" }).getAttribute("aria-pressed"), (on) => on === "true");
    await move(page, { U: from + 400 });
    await until("U at its target", () => position(page, "U"), (at) => at === from + 400);
    await atRest(page, "U");

    const homing = page.getByRole("region", { name: "Home", exact: true });
    await homing.getByText("U", { exact: true }).click();
    await homing.getByLabel("Mode").selectOption("1");
    await homing.getByRole("button", { name: "Home U in negative direction" }).click();
    await until("U homes", () => state(page, "U").innerText(), (text) => text !== "idle");
    await until("U is home", () => state(page, "U").innerText(), (text) => text === "idle");
    assert.equal(await position(page, "U"), 0);
    for (const other of ["X", "Y", "Z"]) assert.equal(await speed(page, other), 0);
  });
});

test("speed and target change on the fly", async () => {
  await look(server, "#/pmx-2ed/control", async (page) => {
    await power(page, "X");
    const fly = page.locator("pt-on-the-fly");
    // The window of speeds is chosen while the motor stands.
    await fly.locator("select[name=window]").selectOption("1");
    await fly.getByRole("button", { name: "Set SSPDMX" }).click();
    await page.getByRole("button", { name: "ABS" }).click();
    await move(page, { X: 100000 });
    await until("X at its speed", () => speed(page, "X"), (pps) => pps === 1000);
    await fly.locator("input[name=speed]").fill("2000");
    await fly.getByRole("button", { name: "Set speed" }).click();
    await until("X twice as fast", () => speed(page, "X"), (pps) => pps === 2000);
    const ahead = (await position(page, "X")) + 6000;
    await fly.locator("input[name=target]").fill(String(ahead));
    await fly.getByRole("button", { name: "Set target" }).click();
    await until("X at the new target", () => position(page, "X"), (at) => at === ahead);
  });
});

test("counters are set, motors are switched off", async () => {
  await look(server, "#/pmx-2ed/control", async (page) => {
    await power(page, "X");
    await page.keyboard.press("Escape");
    await atRest(page, "X");
    await axis(page, "X").getByText("Set counters").click();
    await axis(page, "X").getByLabel("Position counter").fill("-1 234");
    await axis(page, "X").getByRole("button", { name: "Set", exact: true }).first().click();
    await until("X is at -1234", () => position(page, "X"), (at) => at === -1234);
    await axis(page, "X").getByLabel("Encoder counter").fill("77");
    await axis(page, "X").getByRole("button", { name: "Set", exact: true }).last().click();
    await until("its encoder at 77", () => number(axis(page, "X").locator("[data-role=encoder]")), (at) => at === 77);
    await axis(page, "X").getByRole("button", { name: "motor on" }).click();
    await axis(page, "X").getByRole("button", { name: "motor off" }).waitFor();
  });
});

test("a closed loop shows its state and what it is off by", async () => {
  await look(server, "#/pmx-2ed/control", async (page) => {
    for (const line of ["EO=3", "SLRX=1", "SLX=1", "PX=0", "EX=0"]) {
      await server.ask("POST", "/devices/pmx-2ed/terminal", { line });
    }
    await axis(page, "X").getByTitle("StepNLoop").waitFor();
    assert.equal(await axis(page, "X").getByTitle("StepNLoop").innerText(), "idle");
    await until("a delta", () => number(axis(page, "X").locator("[data-role=delta]")), (delta) => Number.isFinite(delta));
    await server.ask("POST", "/devices/pmx-2ed/terminal", { line: "SLX=0" });
    await axis(page, "X").getByTitle("StepNLoop").waitFor({ state: "detached" });
  });
});

test("speeds and ramps of the next moves", async () => {
  await look(server, "#/pd42-1140/control", async (page) => {
    const ramps = page.locator("pt-ramps");
    const speed = ramps.locator("input[name='AP4.0']");
    await until("the speed is read", () => speed.inputValue(), (value) => value === "1000");
    await speed.fill("500");
    await ramps.getByRole("button", { name: "Set" }).click();
    const read = () => server.ask<{ text: string }>("POST", "/devices/pd42-1140/terminal", { line: "GAP 4, 0" });
    await until("the controller has it", read, ({ text }) => /\b500\b/.test(text));
    assert.equal(await state(page, "0").count(), 1);
  });
});
