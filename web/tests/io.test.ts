// Inputs, outputs, and the machine behind the pins of a virtual controller.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Server, look, picture, until, withBrowser } from "./bench.ts";

withBrowser();
let server: Server;
before(async () => {
  server = await Server.start();
});
after(() => server.stop());

const pin = (name: string) => server.ask<boolean | number>("GET", `/devices/pmx-2ed/pins/${encodeURIComponent(name)}`);

test("a switch that is dragged to the carriage is pressed, and let go again", async () => {
  await look(server, "#/pmx-2ed/io", async (page) => {
    const machine = page.getByRole("region", { name: "Machine" });
    const limit = machine.getByRole("button", { name: /^positive limit switch of X/ });
    const carriage = machine.locator("[data-shaft=X]");
    await limit.scrollIntoViewIfNeeded();
    const [from, to] = [await limit.boundingBox(), await carriage.boundingBox()];
    assert.ok(from && to);
    await page.mouse.move(from.x + from.width / 2, from.y + from.height / 2);
    await page.mouse.down();
    await page.mouse.move(to.x + to.width / 2, from.y + from.height / 2, { steps: 12 });
    await until("+LX on", () => pin("+LX"), (on) => on === true);
    await machine.getByRole("button", { name: "positive limit switch of X, on" }).waitFor();
    await picture(page, "io");
    await page.mouse.up();
    await until("+LX off", () => pin("+LX"), (on) => on === false);

    // The same with the keyboard.
    await limit.focus();
    await page.keyboard.down("Space");
    await until("+LX on again", () => pin("+LX"), (on) => on === true);
    await page.keyboard.up("Space");
    await until("+LX off again", () => pin("+LX"), (on) => on === false);
  });
});

test("the machine follows the motor, is loaded, pushed, and loses pulses", async () => {
  await look(server, "#/pmx-2ed/io", async (page) => {
    const machine = page.getByRole("region", { name: "Machine" });
    const read = async () => Number(/shaft ([−\d\s\u2009]+)/.exec(await machine.innerText())?.[1]?.replace(/[\s\u2009]/g, "").replace("−", "-"));
    await server.ask("POST", "/devices/pmx-2ed/act", { do: "power", axis: "X", on: true });
    await server.ask("POST", "/devices/pmx-2ed/act", { do: "move", targets: { X: 400 }, relative: false });
    await until("the shaft at 400", read, (at) => at === 400);
    await machine.getByLabel("Pulses, axis X").fill("-150");
    await machine.getByRole("button", { name: "Push" }).first().click();
    await until("the shaft at 250", read, (at) => at === 250);
    const load = machine.getByRole("slider", { name: "Load" }).first();
    await load.fill("0.5");
    await machine.getByText("50 %").waitFor();
  });
});

test("inputs are pressed, outputs switched, analog values set", async () => {
  await look(server, "#/pmx-2ed/io", async (page) => {
    const pins = page.locator("pt-pins");
    const input = pins.getByRole("button", { name: /^DI3/ });
    await input.hover();
    await page.mouse.down();
    await pins.getByRole("button", { name: "DI3, on" }).waitFor();
    await page.mouse.up();
    await pins.getByRole("button", { name: "DI3, off" }).waitFor();
    await pins.getByLabel("keep pressed").check();
    await input.click();
    await pins.getByRole("button", { name: "DI3, on" }).waitFor();
    const output = pins.getByRole("switch", { name: /^DO2/ });
    await output.click();
    await until("DO2 on", () => output.getAttribute("aria-checked"), (on) => on === "true");
    assert.equal(await pin("DO2"), true);
  });
});

test("faults on purpose, and the power", async () => {
  await look(server, "#/pmx-2ed/io", async (page) => {
    const faults = page.getByRole("region", { name: "Power and faults" });
    await faults.getByLabel("Kind").selectOption({ label: "stuck switch" });
    await faults.locator("select[name=pin]").selectOption("HX");
    await faults.getByRole("button", { name: "Add" }).click();
    await faults.getByRole("cell", { name: "stuck switch", exact: true }).waitFor();
    assert.equal((await server.ask<unknown[]>("GET", "/devices/pmx-2ed/faults")).length, 1);
    await faults.getByRole("button", { name: "Clear stuck switch" }).click();
    await faults.getByText("There is none.").waitFor();

    await server.ask("POST", "/devices/pmx-2ed/terminal", { line: "V5=77" });
    await faults.getByRole("button", { name: "Power cycle" }).click();
    const read = () => server.ask<{ reply: string }>("POST", "/devices/pmx-2ed/terminal", { line: "V5" });
    await until("it has started again", read, ({ reply }) => reply === "0");
  });
});
