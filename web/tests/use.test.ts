// Good to use: every tab of every controller by keyboard, for screen readers, dark and light, and on a phone.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import type { CDPSession, Page } from "playwright-core";
import { DESK, Server, look, picture, until, withBrowser } from "./bench.ts";

const MODELS = ["pd42-1140", "pmx-2ed", "cmd-4cr"];
/** The narrowest phones. */
const NARROW = { width: 360, height: 740 };
/** More stops of the Tab key than any part of the page has. */
const MOST_STOPS = 2000;
/** Keys that are pressed before one looks where they led. */
const STRIDE = 50;
const tabs = (page: Page) => page.getByRole("navigation").getByRole("link");

/** Opens each tab of each controller, and the overview, and waits until it shows something. */
async function everywhere(page: Page, visit: (where: string) => Promise<void>): Promise<void> {
  await page.goto(`${server.url}#/`);
  await page.getByRole("table", { name: "Axes of cmd-4cr" }).getByRole("row").nth(4).waitFor();
  await visit("overview");
  for (const model of MODELS) {
    await page.goto(`${server.url}#/${model}/control`);
    await page.getByRole("region", { name: /^Axis/ }).first().waitFor();
    for (const tab of await tabs(page).all()) {
      const title = await tab.innerText();
      await tab.click();
      const shown = page.locator("main > :not([hidden])");
      await until(`${model} ${title}`, () => shown.evaluateAll((all) =>
        all.length === 1 && (all[0]!.shadowRoot?.childElementCount ?? 0) > 0 && !all[0]!.shadowRoot!.textContent!.includes("Loading…"),
      ), (is) => is);
      // Hundreds of rows that are alike.
      if (title === "Parameters") await page.getByLabel("Search parameters").fill("speed");
      if (title === "Program") await page.getByLabel("not zero").check();
      const tools = page.getByRole("group", { name: "Tools", exact: true }).getByRole("button");
      const parts = title === "Tools" ? await tools.all() : [];
      for (const part of parts) {
        await part.click();
        await visit(`${model}, ${title}, ${await part.innerText()}`);
      }
      if (parts.length === 0) await visit(`${model}, ${title}`);
    }
  }
}

interface Node {
  ignored: boolean;
  role?: { value: string };
  name?: { value: string };
  properties?: { name: string; value: { value: unknown } }[];
}

/** Roles that say nothing without a name. */
const NAMED = new Set([
  "button", "checkbox", "combobox", "dialog", "gridcell", "image", "img", "link", "listbox", "menuitem", "navigation", "option",
  "radio", "region", "searchbox", "slider", "spinbutton", "switch", "tab", "table", "textbox", "application", "log",
]);

/** What has a role that needs a name, and none. */
async function unnamed(session: CDPSession): Promise<string[]> {
  const { nodes } = (await session.send("Accessibility.getFullAXTree")) as { nodes: Node[] };
  assert.ok(nodes.length > 50, `${nodes.length} nodes`);
  return nodes.flatMap(({ ignored, role, name }) =>
    !ignored && role && NAMED.has(role.value) && !name?.value?.trim() ? [`a ${role.value} without a name`] : [],
  );
}

/** Ids that stand twice in one tree: labels and descriptions would mean the wrong one. */
function doubled(): string[] {
  const found: string[] = [];
  const walk = (root: Document | ShadowRoot) => {
    const seen = new Set<string>();
    for (const element of root.querySelectorAll("*")) {
      if (element.id && seen.has(element.id)) found.push(`two with the id ${element.id}`);
      seen.add(element.id);
      if (element.shadowRoot) walk(element.shadowRoot);
    }
  };
  walk(document);
  return found;
}

/** Texts that stand out too little from what is behind them (WCAG 2.2, 1.4.3), and edges of controls (1.4.11). */
function faint(): string[] {
  const LEAST = { text: 4.5, large: 3, control: 3 };
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 1;
  const pen = canvas.getContext("2d", { willReadFrequently: true })!;
  const known = new Map<string, number[]>();
  /** Red, green, blue and opacity, 0 to 1, of whatever CSS can say. */
  const parse = (colour: string): number[] => {
    let parts = known.get(colour);
    if (!parts) {
      pen.clearRect(0, 0, 1, 1);
      pen.fillStyle = colour;
      pen.fillRect(0, 0, 1, 1);
      parts = [...pen.getImageData(0, 0, 1, 1).data].map((part) => part / 255);
      known.set(colour, parts);
    }
    return parts;
  };
  const over = (front: number[], back: number[]) => back.map((part, n) => (n < 3 ? front[n]! * front[3]! + part * (1 - front[3]!) : 1));
  const light = (colour: number[]) => {
    const [r, g, b] = colour.map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r! + 0.7152 * g! + 0.0722 * b!;
  };
  const contrast = (one: number[], other: number[]) => {
    const [bright, dark] = [light(one), light(other)].sort((a, b) => b - a);
    return (bright! + 0.05) / (dark! + 0.05);
  };
  const parent = (element: Element): Element | null =>
    element.assignedSlot ?? element.parentElement ?? (element.getRootNode() as ShadowRoot).host ?? null;
  const backs = new Map<Element, number[]>();
  const backOf = (element: Element | null): number[] => {
    if (!element) return [1, 1, 1, 1];
    let back = backs.get(element);
    if (!back) {
      const colour = parse(getComputedStyle(element).backgroundColor);
      back = colour[3] === 1 ? colour : over(colour, backOf(parent(element)));
      backs.set(element, back);
    }
    return back;
  };
  const faults = new Set<string>();
  const walk = (root: Document | ShadowRoot) => {
    for (const element of root.querySelectorAll("*")) {
      if (element.shadowRoot) walk(element.shadowRoot);
      if (!(element instanceof HTMLElement) || !element.checkVisibility({ opacityProperty: true, visibilityProperty: true })) continue;
      // What cannot be used, and is said to be so, need not stand out.
      if (element.matches(":disabled") || element.closest(":disabled, .visually-hidden, .stale")) continue;
      const style = getComputedStyle(element);
      const back = backOf(element);
      const label = `${element.localName}${element.className ? `.${String(element.className).trim().replaceAll(/\s+/g, ".")}` : ""}`;
      const texts = [...element.childNodes].filter((node) => node.nodeType === Node.TEXT_NODE && node.textContent!.trim() !== "");
      const field = element instanceof HTMLInputElement && !["range", "checkbox", "radio"].includes(element.type);
      if (texts.length > 0 || field) {
        const large = parseFloat(style.fontSize) >= 24 || (parseFloat(style.fontSize) >= 18.66 && Number(style.fontWeight) >= 700);
        const ratio = contrast(over(parse(style.color), back), back);
        if (ratio < (large ? LEAST.large : LEAST.text)) faults.add(`${label} “${texts[0]?.textContent?.trim().slice(0, 30) ?? ""}” ${ratio.toFixed(2)}`);
      }
      if (field || element instanceof HTMLSelectElement || element instanceof HTMLTextAreaElement) {
        const ratio = contrast(over(parse(style.borderTopColor), back), backOf(parent(element)));
        if (ratio < LEAST.control) faults.add(`edge of ${label} ${ratio.toFixed(2)}`);
      }
    }
  };
  walk(document);
  return [...faults];
}

interface Stop {
  id: number;
  path: string;
  visible: boolean;
}

/** Notes each element that gets the focus, and whether it shows that, in `window.stops`. */
function noteStops(): void {
  const known: Element[] = [];
  const stops: Stop[] = [];
  const past = (window as { noting?: AbortController }).noting;
  past?.abort();
  const noting = new AbortController();
  Object.assign(window, { stops, noting });
  window.addEventListener("focusin", (event) => {
    const element = event.composedPath()[0] as Element;
    if (!known.includes(element)) known.push(element);
    const path = event.composedPath().filter((one) => one instanceof HTMLElement).map((one) => one.localName).reverse();
    const { outlineStyle, outlineWidth } = getComputedStyle(element);
    const ring = outlineStyle !== "none" && parseFloat(outlineWidth) >= 1;
    // The editor's focus is its cursor and the line that it is in; a switch of the machine is drawn thicker.
    const own = element.closest(".cm-editor") !== null || element.matches("g.switch:focus-visible");
    stops.push({ id: known.indexOf(element), path: `${path.join(" ")} ${element.getAttribute("aria-label") ?? element.textContent!.trim()}`, visible: ring || own });
  }, { signal: noting.signal });
}

/** Tab after Tab, until it is round; what was wrong on the way. */
async function byKeyboard(page: Page, session: CDPSession): Promise<string[]> {
  await page.evaluate(noteStops);
  await page.getByRole("link", { name: "Pulsetrain, all controllers" }).focus();
  const key = { key: "Tab", code: "Tab", windowsVirtualKeyCode: 9 };
  for (let pressed = 0; pressed < MOST_STOPS; pressed += STRIDE) {
    // Without waiting for each: there are hundreds.
    await Promise.all(Array.from({ length: STRIDE }, () => [
      session.send("Input.dispatchKeyEvent", { type: "rawKeyDown", ...key }),
      session.send("Input.dispatchKeyEvent", { type: "keyUp", ...key }),
    ]).flat());
    const stops = await page.evaluate(() => (window as unknown as { stops: Stop[] }).stops);
    const round = stops.findIndex(({ id }, n) => n > 0 && id === 0);
    const seen = stops.slice(0, round < 0 ? undefined : round);
    const hidden = seen.filter(({ visible }) => !visible).map(({ path }) => `${path} does not show that it has the focus`);
    const caught = seen.find(({ id }, n) => seen.findIndex((other) => other.id === id) < n);
    if (caught) return [...hidden, `caught at ${caught.path}`];
    if (round > 0) return hidden;
  }
  return [`not round after ${MOST_STOPS} keys`];
}

withBrowser();
let server: Server;
before(async () => {
  server = await Server.start();
});
after(() => server.stop());

/** What is wrong, and where. */
async function walk() {
  const faults = { names: [] as string[], colours: [] as string[], keyboard: [] as string[], width: [] as string[], motion: [] as string[] };
  await look(server, null, async (page, { context }) => {
    const session = await context.newCDPSession(page);
    await everywhere(page, async (where) => {
      const note = (kind: keyof typeof faults, what: string[]) => faults[kind].push(...what.map((fault) => `${where}: ${fault}`));
      note("names", [...(await unnamed(session)), ...(await page.evaluate(doubled))]);
      note("keyboard", await byKeyboard(page, session));
      for (const colorScheme of ["dark", "light"] as const) {
        await page.emulateMedia({ colorScheme, reducedMotion: "reduce" });
        note("colours", (await page.evaluate(faint)).map((fault) => `${colorScheme}: ${fault}`));
      }
      const moving = await page.evaluate(() => document.getAnimations().length);
      if (moving > 0) note("motion", [`${moving} animations`]);
      await page.setViewportSize(NARROW);
      // What is drawn follows a frame later.
      const fits = () => document.documentElement.scrollWidth <= window.innerWidth;
      await page.waitForFunction(fits, null, { timeout: 2000 }).catch(async () => {
        note("width", [`${await page.evaluate(() => document.documentElement.scrollWidth)} pixels wide`]);
      });
      if (where === "pmx-2ed, Control") await picture(page, "phone");
      await page.setViewportSize(DESK);
    });
    // What happens is said when there is time, what is wrong at once.
    const live = await page.locator("pt-toasts [aria-live]").evaluateAll((all) => all.map((one) => one.getAttribute("aria-live")));
    if (live.join() !== "polite,assertive") faults.names.push(`live regions: ${live.join()}`);
  });
  return faults;
}

// One walk for all tests: what takes time is to go there.
let walked: ReturnType<typeof walk> | null = null;
const faults = () => (walked ??= walk());

test("every button, field, slider and table has a name for screen readers, and no id is there twice", async () => {
  assert.deepEqual((await faults()).names, []);
});

test("texts and fields stand out from what is behind them, dark and light", async () => {
  assert.deepEqual([...new Set((await faults()).colours)], []);
});

test("the keyboard goes through every tab, is seen where it is, and is never caught", async () => {
  assert.deepEqual((await faults()).keyboard, []);
});

test("nothing is wider than the narrowest phone", async () => {
  assert.deepEqual((await faults()).width, []);
});

test("nothing moves by itself for whoever does not want it", async () => {
  assert.deepEqual((await faults()).motion, []);
});
