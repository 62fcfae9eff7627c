// Writing programs and running them.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import type { Page } from "playwright-core";
import { Server, look, picture, until, withBrowser } from "./bench.ts";

withBrowser();
let server: Server;
before(async () => {
  server = await Server.start();
});
after(() => server.stop());

const editor = (page: Page) => page.getByRole("textbox", { name: "Program" });

/** Types a program in place of what is there. */
async function write(page: Page, text: string): Promise<void> {
  await page.getByText("checked as you type").waitFor();
  await editor(page).click();
  await page.keyboard.press("ControlOrMeta+a");
  await page.keyboard.press("Delete");
  await page.keyboard.insertText(text);
}

const threads = (page: Page) => page.getByRole("table", { name: "Programs" });
const press = (page: Page, name: string) => page.getByRole("button", { name, exact: true }).click();

const TMCL = `// Counts in a variable.
SGP 5, 2, 0
Loop:
WAIT TICKS, 0, 5
GGP 5, 2
CALC ADD, 1
AGP 5, 2
JA Loop
`;

test("an error is marked while it is typed; mended, the program runs, pauses and stops", async () => {
  await look(server, "#/pd42-1140/program", async (page) => {
    await write(page, TMCL.replace("JA Loop", "JA Lopp"));
    await page.locator(".cm-lintRange-error").waitFor();
    await page.locator(".cm-lintRange-error").hover();
    await page.locator(".cm-tooltip").getByText(/Lopp/).first().waitFor();
    await press(page, "Compile");
    await page.getByRole("region", { name: "Output of the compiler" }).getByText(/Lopp/).waitFor();

    await write(page, TMCL);
    await page.locator(".cm-lintRange-error").waitFor({ state: "detached" });
    await press(page, "Download");
    await page.getByText("as in the controller").waitFor();
    await press(page, "Run Program");
    await threads(page).getByText("running").waitFor();
    const counted = async () => Number((await server.ask<{ text: string }>("POST", "/devices/pd42-1140/terminal", { line: "GGP 5, 2" })).text.match(/-?\d+(?!.*\d)/)?.[0]);
    await until("it counts", counted, (value) => value > 2);
    await press(page, "Stop Program");
    await threads(page).getByText("idle").or(threads(page).getByText("paused")).first().waitFor();
  });
});

test("a breakpoint holds the controller, which is stepped line by line, watched and let go", async () => {
  await look(server, "#/pd42-1140/program", async (page) => {
    await write(page, TMCL);
    await press(page, "Download");
    await page.getByText("as in the controller").waitFor();
    const gutter = page.locator(".cm-breakpoints .cm-gutterElement");
    // Line 6, `CALC ADD, 1`; the first element of a gutter is its spacer.
    await gutter.nth(6).click();
    await page.locator(".cm-breakpoint").nth(1).waitFor({ state: "attached" });
    await press(page, "Run Program");
    await threads(page).getByText("held").waitFor();
    await threads(page).getByText("line 6").waitFor();
    await picture(page, "program", "dark");
    const seconds = async () => (await server.ask<{ device_seconds: number }>("GET", "/devices/pd42-1140")).device_seconds;
    const stood = await seconds();
    await page.waitForTimeout(200);
    assert.equal(await seconds(), stood, "time stands");
    await press(page, "Step");
    await threads(page).getByText("line 7").waitFor();
    await press(page, "Go on");
    await threads(page).getByText("line 6").waitFor();
    await page.getByRole("table", { name: "Variables" }).getByRole("row").first().waitFor();
    await gutter.nth(6).click();
    await press(page, "Go on");
    await threads(page).getByText("running").waitFor();
    await press(page, "Animate");
    await threads(page).getByText("held").waitFor();
    await press(page, "Animate");
    await press(page, "Go on");
    await press(page, "Stop Program");
  });
});

const LOOP = `PRG 0
V1=0
WHILE 1=1
  V1=V1+1
  GOSUB 3
ENDWHILE
END
SUB 3
  V2=V1*10
  DELAY=20
ENDSUB
`;

test("A-SCRIPT is held at a breakpoint, stepped into a subroutine, watched and animated", async () => {
  await look(server, "#/cmd-4cr/program", async (page) => {
    await write(page, LOOP);
    await press(page, "Download");
    await page.getByText("as in the controller").waitFor();
    const gutter = page.locator(".cm-breakpoints .cm-gutterElement");
    const breakpoints = page.locator(".cm-breakpoint");
    // Line 4, `V1=V1+1`; the first element of a gutter is its spacer.
    await gutter.nth(4).click();
    await breakpoints.nth(1).waitFor({ state: "attached" });
    await press(page, "Run Program 0");
    await threads(page).getByText("held").waitFor();
    await threads(page).getByText("line 4").waitFor();
    const variable = (name: string) => page.getByRole("table", { name: "Variables" }).getByLabel(name, { exact: true });
    const shows = (name: string, value: string) => until(name, () => variable(name).inputValue(), (shown) => shown === value);
    await shows("V1", "0");

    for (const line of [5, 8, 9, 10]) {
      await press(page, "Step");
      await threads(page).getByText(`line ${line}`, { exact: true }).waitFor();
    }
    await shows("V1", "1");
    await shows("V2", "10");
    // What has just changed is marked, with what it was.
    await page.getByRole("row").filter({ has: page.getByLabel("V2", { exact: true }) }).getByText("0 →").waitFor();
    assert.equal(await server.say("cmd-4cr", "V2"), "10");
    await press(page, "Go on");
    await threads(page).getByText("line 4", { exact: true }).waitFor();
    await press(page, "Go on");
    await shows("V1", "2");

    await gutter.nth(4).click();
    await breakpoints.nth(1).waitFor({ state: "detached" });
    await page.getByLabel("Lines a second").selectOption("10");
    await press(page, "Animate");
    // Round the loop by itself, line by line.
    await until("it goes round", async () => Number(await variable("V1").inputValue()), (rounds) => rounds >= 4);
    await press(page, "Animate");
    await threads(page).getByText("held").waitFor();
    await press(page, "Go on");
    await threads(page).getByText("running").waitFor();
    await press(page, "Stop Program 0");
    await until("it stands", () => threads(page).getByText("idle").count(), (count) => count >= 1);
  });
});

test("programs of a Performax: two at once, paused and continued, uploaded again", async () => {
  await look(server, "#/pmx-2ed/program", async (page) => {
    await write(page, "PRG 0\nV1=0\nWHILE 1=1\nV1=V1+1\nDELAY=20\nENDWHILE\nEND\nPRG 1\nV2=7\nDELAY=60000\nEND\n");
    await press(page, "Format");
    await until("it is indented", () => editor(page).innerText(), (text) => /\n {2,}V1=V1\+1|\n\tV1=V1\+1/.test(text));
    await press(page, "Compile");
    await press(page, "Listing");
    await page.getByRole("region", { name: "Output of the compiler" }).getByText(/V1/).first().waitFor();
    await press(page, "Download");
    await page.getByText("as in the controller").waitFor();
    await press(page, "Run Program 0");
    await press(page, "Run Program 1");
    await until("both run", () => threads(page).getByText("running").count(), (count) => count === 2);
    await press(page, "Pause Program 0");
    await threads(page).getByText("paused").waitFor();
    await press(page, "Continue Program 0");
    await until("both run again", () => threads(page).getByText("running").count(), (count) => count === 2);
    const variable = page.getByRole("table", { name: "Variables" }).getByLabel("V2", { exact: true });
    await until("V2 is shown", () => variable.inputValue(), (value) => value === "7");
    await variable.fill("8");
    await variable.press("Enter");
    const v2 = async () => (await server.ask<{ reply: string }>("POST", "/devices/pmx-2ed/terminal", { line: "V2" })).reply;
    await until("V2 is set", v2, (text) => text === "8");
    await press(page, "Stop Program 0");
    await press(page, "Stop Program 1");

    await press(page, "New");
    await press(page, "Upload");
    await until("it is back", () => editor(page).innerText(), (text) => /WHILE/.test(text) && /PRG 1/.test(text));
  });
});

test("completion and help while typing, files and symbols", async () => {
  await look(server, "#/pd42-1140/program", async (page) => {
    await write(page, "Loop: MVP ABS, 0, 1000\nWAI");
    await page.keyboard.press("Control+Space");
    await page.locator(".cm-tooltip-autocomplete").getByText("WAIT").first().waitFor();
    await page.keyboard.press("Escape");
    await write(page, "Loop: MVP ABS, 0, 1000\nJA Loop\n");
    const word = await editor(page).locator("span", { hasText: /^MVP$/ }).boundingBox();
    assert.ok(word);
    await page.mouse.move(word.x + 8, word.y + 60);
    await page.mouse.move(word.x + 8, word.y + word.height / 2, { steps: 4 });
    await page.locator(".cm-tooltip").getByText(/position/i).first().waitFor();
    await press(page, "Compile");
    await press(page, "Symbols");
    await page.getByRole("region", { name: "Output of the compiler" }).getByText(/Loop/).first().waitFor();
    const download = page.waitForEvent("download");
    await page.getByRole("button", { name: "Save", exact: true }).first().click();
    assert.match(await readFile(await (await download).path(), "utf8"), /JA Loop/);
    const chooser = page.waitForEvent("filechooser");
    await press(page, "Open");
    await (await chooser).setFiles({ name: "other.tmc", mimeType: "text/plain", buffer: Buffer.from("STOP\n") });
    await until("the file is open", () => editor(page).innerText(), (text) => text.trim() === "STOP");
    await page.getByLabel("Examples").selectOption({ index: 1 });
    await until("an example is open", () => editor(page).innerText(), (text) => text.length > 100);
  });
});
