// Who may do what, and what happens when the server goes away.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import type { Status } from "../src/api/contract.ts";
import { Server, look, open, until, withBrowser } from "./bench.ts";

/** What loading the page may cost, compressed. */
const MAX_LOAD_BYTES = 300_000;

withBrowser();
let server: Server;
before(async () => {
  server = await Server.start();
});
after(() => server.stop());

test("two windows, one of which has control; the other one can look, stop, and take over", async () => {
  const [one, two] = [await open(server, "#/pmx-2ed/control"), await open(server, "#/pmx-2ed/control")];
  const motor = (window: typeof one) =>
    window.page.getByRole("region", { name: "Axis X", exact: true }).getByRole("button", { name: /^motor/ });
  await motor(one).click();
  await one.page.getByText("you have control").waitFor();
  await two.page.getByText("has control. You can look, and stop.").waitFor();
  assert.ok(await motor(two).isDisabled());
  await two.page.getByRole("button", { name: "■ STOP" }).click();
  await two.page.getByText("Stop sent to pmx-2ed").waitFor();

  await two.page.getByRole("button", { name: "Take over" }).click();
  await two.page.getByText("you have control").waitFor();
  await one.page.getByText("has control. You can look, and stop.").waitFor();
  await until("the second window may switch", () => motor(two).isEnabled(), (may) => may);

  // A window that closes gives control back.
  await two.context.close();
  await one.page.getByText("has control.").waitFor({ state: "detached", timeout: 30_000 });
  await motor(one).click();
  await one.page.getByText("you have control").waitFor();
  await one.context.close();
});

test("the server is lost and regained", async () => {
  const first = await Server.start({ devices: ["pmx-2ed@tcp:127.0.0.1:0"], token: "known" });
  const window = await open(first, "#/pmx-2ed/control");
  const motor = window.page.getByRole("region", { name: "Axis X", exact: true }).getByRole("button", { name: /^motor/ });
  await until("it can be used", () => motor.isEnabled(), (may) => may);
  await first.stop();
  await window.page.getByRole("alert").filter({ hasText: "The server does not answer" }).waitFor();
  assert.ok(await motor.isDisabled());
  const second = await Server.start({ devices: ["pmx-2ed@tcp:127.0.0.1:0"], http: first.address, token: "known" });
  await until("it can be used again", () => motor.isEnabled(), (may) => may);
  assert.equal(await window.page.getByRole("alert").filter({ hasText: "The server does not answer" }).count(), 0);
  await window.context.close();
  await second.stop();
});

test("without the token the page asks for it, and the address does not keep it", async () => {
  const window = await open(server, "#/");
  await window.page.getByRole("link", { name: "pmx-2ed", exact: true }).waitFor();
  assert.ok(!window.page.url().includes("token"));
  assert.deepEqual(await window.context.cookies(), []);
  await window.page.evaluate(() => sessionStorage.clear());
  await window.page.goto(`http://${server.address}/#/`);
  await window.page.reload();
  await window.page.getByLabel("Token").fill(server.token);
  await window.page.getByRole("button", { name: "Open" }).click();
  await window.page.getByRole("link", { name: "pmx-2ed", exact: true }).waitFor();
  await window.context.close();
});

test("somebody else's page gets nothing", async () => {
  const ask = (headers: Record<string, string>) =>
    fetch(`http://${server.address}/api/devices`, { headers: { Authorization: `Bearer ${server.token}`, ...headers } });
  assert.equal((await ask({})).status, 200);
  assert.equal((await ask({ Origin: `http://${server.address}` })).status, 200);
  assert.equal((await ask({ Origin: "http://evil.example" })).status, 403);
  assert.equal((await ask({ Authorization: "Bearer wrong" })).status, 401);
  const page = await fetch(`http://${server.address}/`);
  const policy = page.headers.get("content-security-policy") ?? "";
  assert.match(policy, /default-src 'none'/);
  assert.match(policy, /script-src 'self'(;|$)/);
});

test("the page loads with less than 300 KB", async () => {
  await look(server, null, async (page, { context }) => {
    let bytes = 0;
    const session = await context.newCDPSession(page);
    await session.send("Network.enable");
    await session.send("Network.setCacheDisabled", { cacheDisabled: true });
    session.on("Network.loadingFinished", (event) => {
      bytes += event.encodedDataLength;
    });
    await page.goto(`${server.url}#/pmx-2ed/control`);
    await page.getByRole("region", { name: "Axis X", exact: true }).waitFor();
    console.log(`# the page loads with ${bytes} bytes`);
    assert.ok(bytes > 10_000 && bytes < MAX_LOAD_BYTES, `${bytes}`);
  });
});

test("a controller is opened and its motor switched without a mouse", async () => {
  await look(server, "#/", async (page) => {
    await page.getByRole("link", { name: "pmx-2ed", exact: true }).focus();
    await page.keyboard.press("Enter");
    const motor = page.getByRole("region", { name: "Axis X", exact: true }).getByRole("button", { name: /^motor/ });
    await until("it can be used", () => motor.isEnabled(), (may) => may);
    const before = await motor.innerText();
    await motor.focus();
    await page.keyboard.press("Space");
    await until("the motor is switched", () => motor.innerText(), (text) => text !== before);
  });
});

test("dark and light", async () => {
  await look(server, "#/", async (page) => {
    const background = () => page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor);
    const light = await background();
    await page.getByLabel("Colours").selectOption("dark");
    await until("it is dark", background, (colour) => colour !== light);
  });
});

// The last one: a page that is gone keeps control for ten seconds.
test("an axis that is jogged stops when the page is gone, or its network", async () => {
  const speed = async () => (await server.ask<Status>("GET", "/devices/cmd-4cr/status")).axes["X"]!.speed;
  for (const goes of ["page", "network"] as const) {
    server.lease = null;
    const { page, context } = await open(server, "#/cmd-4cr/control");
    // The first window is gone and could not give control back.
    if (goes === "network") await page.getByRole("button", { name: "Take over" }).click();
    const axis = page.getByRole("region", { name: "Axis X", exact: true });
    const motor = axis.getByRole("button", { name: /^motor/ });
    await until("it can be used", () => motor.isEnabled(), (may) => may);
    if ((await motor.getAttribute("aria-pressed")) === "false") await motor.click();
    await until("the motor on", () => motor.getAttribute("aria-pressed"), (on) => on === "true");
    await axis.getByRole("button", { name: "Jog X in positive direction while pressed" }).hover();
    await page.mouse.down();
    await until("X moves", speed, (pps) => pps > 0);
    // Longer than the server's patience: the page says all the time that the button is held.
    const end = Date.now() + 1000;
    while (Date.now() < end) assert.ok((await speed()) > 0);

    const gone = Date.now();
    if (goes === "page") {
      // As if the browser had been killed: nothing of the page runs any more.
      const killer = await context.newCDPSession(page);
      void killer.send("Page.crash").catch(() => undefined);
    } else {
      await context.setOffline(true);
    }
    await until(`X stands without the ${goes}`, speed, (pps) => pps === 0);
    const late = Date.now() - gone;
    console.log(`# X stands ${late} ms after the ${goes} is gone`);
    assert.ok(late < 2500, `${late} ms`);
    // A page that has crashed cannot be asked to close.
    if (goes === "network") await context.close();
  }
});
