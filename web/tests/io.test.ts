// Inputs, outputs, and the machine behind the pins of a virtual controller.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import type { Page } from "playwright-core";
import type { Machine, Status } from "../src/api/contract.ts";
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

test("a limit switch is mounted elsewhere, by pointer and by keys, and the axis runs into it", async () => {
  await look(server, "#/pmx-2ed/io", async (page) => {
    const machine = page.getByRole("region", { name: "Machine" });
    const mounted = async () => (await server.ask<Machine>("GET", "/devices/pmx-2ed/machine")).axes["Y"]!;
    const limit = machine.getByRole("button", { name: /^positive limit switch of Y/ });
    const home = machine.getByRole("button", { name: /^home switch of Y/ });
    await machine.getByRole("button", { name: "Move switches" }).click();
    await limit.scrollIntoViewIfNeeded();
    const [from, near] = [await limit.boundingBox(), await machine.locator("[data-shaft=Y]").boundingBox()];
    assert.ok(from && near);
    await page.mouse.move(from.x + from.width / 2, from.y + from.height / 2);
    await page.mouse.down();
    await page.mouse.move(near.x + near.width / 2 + 20, from.y + from.height / 2, { steps: 6 });
    await page.mouse.up();
    const dragged = await until("the limit is nearer", mounted, ({ positive_limit }) => positive_limit! < 100_000);
    assert.ok(dragged.positive_limit! > 0);
    await limit.focus();
    await page.keyboard.press("ArrowLeft");
    const end = (await until("nearer still", mounted, ({ positive_limit }) => positive_limit! < dragged.positive_limit!)).positive_limit!;
    // The home switch goes along the rail as wide as it is.
    await home.focus();
    await page.keyboard.press("ArrowLeft");
    const { home: zone } = await until("the home switch", mounted, (axis) => axis.home![0] < dragged.home![0]);
    assert.equal(zone![1] - zone![0], dragged.home![1] - dragged.home![0]);

    for (const line of ["EO=3", "HSPDY=200000", "LSPDY=1000", "ACCY=50"]) await server.say("pmx-2ed", line);
    await server.ask("POST", "/devices/pmx-2ed/act", { do: "move", targets: { Y: 900_000 }, relative: false });
    const stopped = await until("Y is stopped", () => axisOf("pmx-2ed", "Y"), ({ error, speed }) => error !== null && speed === 0);
    assert.match(stopped.error!, /limit/);
    assert.equal(stopped.position, end);
    await machine.getByRole("button", { name: "positive limit switch of Y, on" }).waitFor();
    await server.say("pmx-2ed", "CLRY");
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

/** Where an axis is and how fast it goes. */
const axisOf = async (device: string, name: string) => (await server.ask<Status>("GET", `/devices/${device}/status`)).axes[name]!;

/** What lets a joystick move both axes at up to 2,000 pps anywhere: as the manuals set it up. */
const JOYSTICKS: Record<string, string[]> = {
  "pmx-2ed": [
    ...["JV1=2000", "JV2=2000", "JV3=100", "JV4=100", "JV5=100", "JV6=100"],
    ...["JL1=-90000", "JL2=-80000", "JL3=80000", "JL4=90000", "JL5=-90000", "JL6=-80000", "JL7=80000", "JL8=90000"],
    ...["EO=3", "JO=3"],
  ],
  "cmd-4cr": [
    ...["JSPDX=2000", "JSPDY=2000", "JDELX=100", "JDELY=100", "JTOLX=100", "JTOLY=100"],
    ...["JLIM1=-90000", "JLIM2=-80000", "JLIM3=80000", "JLIM4=90000"],
    ...["JLIM5=-90000", "JLIM6=-80000", "JLIM7=80000", "JLIM8=90000", "EO=15", "JENA=3"],
  ],
};

test("the stick of a joystick moves both axes, by pointer and by keys, and springs back", async () => {
  for (const [device, lines] of Object.entries(JOYSTICKS)) {
    server.lease = null;
    for (const line of lines) await server.say(device, line);
    await look(server, `#/${device}/io`, async (page) => {
      const stick = page.getByRole("region", { name: "Joystick" }).getByRole("application");
      await stick.scrollIntoViewIfNeeded();
      const box = await stick.boundingBox();
      assert.ok(box);
      const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
      await page.mouse.move(x, y);
      await page.mouse.down();
      // To the right and down: X forwards, Y backwards.
      await page.mouse.move(x + 50, y + 50, { steps: 4 });
      await until("X goes forwards", () => axisOf(device, "X"), ({ position, speed }) => position > 50 && speed > 0);
      await until("Y goes backwards", () => axisOf(device, "Y"), ({ position, speed }) => position < -50 && speed !== 0);
      await page.mouse.up();
      await until("X stands", () => axisOf(device, "X"), ({ speed }) => speed === 0);
      await until("Y stands", () => axisOf(device, "Y"), ({ speed }) => speed === 0);

      const before = (await axisOf(device, "X")).position;
      await stick.focus();
      await page.keyboard.down("ArrowLeft");
      await until("X comes back", () => axisOf(device, "X"), ({ position }) => position < before - 50);
      await page.keyboard.up("ArrowLeft");
      await until("X stands again", () => axisOf(device, "X"), ({ speed }) => speed === 0);
    });
    server.lease = null;
    await server.say(device, device === "pmx-2ed" ? "JO=0" : "JENA=0");
  }
});

test("a hand wheel turns an axis, through its gear", async () => {
  await look(server, "#/cmd-4cr/io", async (page) => {
    for (const line of ["EO=15", "ABORT", "PZ=0", "MPMZ=3", "MPEZ=1"]) await server.say("cmd-4cr", line);
    const wheel = page.getByRole("region", { name: "Hand wheel" });
    await wheel.getByText("Z", { exact: true }).click();
    await wheel.getByRole("button", { name: "+100" }).click();
    await until("Z at 300", () => axisOf("cmd-4cr", "Z"), ({ position, speed }) => position === 300 && speed === 0);
    await wheel.getByRole("button", { name: "−10", exact: true }).click();
    await until("Z at 270", () => axisOf("cmd-4cr", "Z"), ({ position, speed }) => position === 270 && speed === 0);
    await server.say("cmd-4cr", "MPEZ=0");
  });
});

/** Power cycle, or cut after a question; then the controller has started again. */
async function switchOff(page: Page, button: "Power cycle" | "Power cut"): Promise<void> {
  await page.getByRole("region", { name: "Power and faults" }).getByRole("button", { name: button }).click();
  if (button === "Power cut") await page.getByRole("button", { name: "Cut", exact: true }).click();
  await page.getByRole("status").getByText(button === "Power cut" ? "Power cut" : "Switched off and on").waitFor();
  await until("it answers", () => server.say("pmx-2ed", "ID"), (reply) => reply.startsWith("PERFORMAX"));
}

test("the power goes and comes back: what was stored is kept, what was not is gone", async () => {
  await look(server, "#/pmx-2ed/io", async (page) => {
    for (const [button, moves] of [["Power cycle", false], ["Power cut", true]] as const) {
      for (const line of ["EO=3", "V5=77", "LCAX=4000", "STORE", "LCAX=1500"]) await server.say("pmx-2ed", line);
      if (moves) {
        await server.ask("POST", "/devices/pmx-2ed/act", { do: "jog", axis: "X", direction: 1 });
        await until("X moves", () => axisOf("pmx-2ed", "X"), ({ speed }) => speed > 0);
      }
      await switchOff(page, button);
      await until("V5 is gone", () => server.say("pmx-2ed", "V5"), (reply) => reply === "0");
      assert.equal(await server.say("pmx-2ed", "LCAX"), "4000");
      const { position, speed, enabled } = await axisOf("pmx-2ed", "X");
      assert.deepEqual({ position, speed, enabled }, { position: 0, speed: 0, enabled: false });
      // The page goes on by itself.
      const machine = page.getByRole("region", { name: "Machine" });
      await until("the counter is shown", () => machine.innerText(), (text) => /counter 0\b/.test(text));
    }
  });
});

test("faults on purpose", async () => {
  await look(server, "#/pmx-2ed/io", async (page) => {
    const faults = page.getByRole("region", { name: "Power and faults" });
    await faults.getByLabel("Kind").selectOption({ label: "stuck switch" });
    await faults.locator("select[name=pin]").selectOption("HX");
    await faults.getByRole("button", { name: "Add" }).click();
    await faults.getByRole("cell", { name: "stuck switch", exact: true }).waitFor();
    assert.equal((await server.ask<unknown[]>("GET", "/devices/pmx-2ed/faults")).length, 1);
    await faults.getByRole("button", { name: "Clear stuck switch" }).click();
    await faults.getByText("There is none.").waitFor();
  });
});
