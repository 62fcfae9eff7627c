// A server with virtual controllers and a browser that looks at its page. The environment says which program and
// which browser: PULSETRAIN and CHROMIUM. While one works on the page, PULSETRAIN_PAGE is a folder with a built one that
// takes the place of the program's own, so that nothing has to be linked anew.

import { type ChildProcess, spawn } from "node:child_process";
import { mkdir, mkdtemp, rm, writeFile } from "node:fs/promises";
import { once } from "node:events";
import type { Server as HttpServer } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { after, before } from "node:test";
import assert from "node:assert/strict";
import { chromium, type Browser, type BrowserContext, type Locator, type Page } from "playwright-core";
import { portOf, standIn } from "./stand-in.ts";

const PROGRAM = process.env.PULSETRAIN ?? "target/release/pulsetrain";
const CHROMIUM = process.env.CHROMIUM ?? "/usr/bin/chromium";
const PICTURES = process.env.PULSETRAIN_PICTURES;
const PAGE = process.env.PULSETRAIN_PAGE;

/** How long anything may take before a test fails. */
export const PATIENCE_MS = 15_000;

const FLAGS = [
  "--no-sandbox",
  "--disable-gpu",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
];

export const DESK = { width: 1280, height: 800 };
export const PHONE = { width: 390, height: 844 };

/** One of each controller. */
const EACH = ["pd42-1140@tcp:127.0.0.1:0", "pmx-2ed@tcp:127.0.0.1:0", "cmd-4cr@tcp:127.0.0.1:0"];

/** What a server is started with. */
export interface Setup {
  /** Devices and their endpoints; one of each without them and without a bench. */
  devices?: string[];
  /** A bench file's text. */
  bench?: string;
  /** Where the page is. */
  http?: string;
  token?: string;
  /** Seconds of the devices a second. */
  speed?: number;
}

/** A running `pulsetrain serve`. */
export class Server {
  /** Of the page, with the token. */
  readonly url: string;
  readonly #process: ChildProcess;
  /** The control that the newest page has; what the tests ask goes in its name. */
  lease: string | null = null;

  readonly #front: HttpServer | null;

  private constructor(process: ChildProcess, url: string, front: HttpServer | null) {
    this.#process = process;
    this.#front = front;
    this.url = front === null ? url : url.replace(new URL(url).host, `127.0.0.1:${portOf(front)}`);
  }

  static async start({ devices, bench, http = "127.0.0.1:0", token, speed = 1 }: Setup = {}): Promise<Server> {
    const env = token === undefined ? process.env : { ...process.env, PULSETRAIN_TOKEN: token };
    const folder = await mkdtemp(join(tmpdir(), "pulsetrain-"));
    const file = join(folder, "bench.toml");
    if (bench !== undefined) await writeFile(file, bench);
    const what = bench === undefined ? (devices ?? EACH) : ["--bench", file];
    // With a page of its own the program is behind it, anywhere.
    const where = PAGE === undefined ? http : "127.0.0.1:0";
    const child = spawn(PROGRAM, ["serve", ...what, "--http", where, "--speed", String(speed)], {
      stdio: ["ignore", "pipe", "inherit"],
      env,
    });
    try {
      for await (const line of createInterface({ input: child.stdout! })) {
        const url = /^ready http (.*)$/.exec(line)?.[1];
        if (url === undefined) continue;
        child.stdout!.resume();
        const behind = new URL(url).host;
        const port = Number(new URL(`http://${http}`).port);
        return new Server(child, url, PAGE === undefined ? null : await standIn(PAGE, behind, port));
      }
    } finally {
      await rm(folder, { recursive: true });
    }
    throw new Error("the server ended before it was ready");
  }

  /** Ends it; a second time does nothing. */
  async stop(): Promise<void> {
    if (this.#process.exitCode === null && this.#process.signalCode === null) {
      const ended = once(this.#process, "exit");
      this.#process.kill("SIGTERM");
      await ended;
    }
    this.#front?.closeAllConnections();
    this.#front?.close();
  }

  get address(): string {
    return new URL(this.url).host;
  }

  get token(): string {
    return new URL(this.url).searchParams.get("token")!;
  }

  /** Types a command into a device, past the page, and gives its reply. */
  async say(device: string, line: string): Promise<string> {
    return (await this.ask<{ reply: string }>("POST", `/devices/${device}/terminal`, { line })).reply;
  }

  /** Asks the interface that programs use, past the page. */
  async ask<T = unknown>(method: string, path: string, body?: unknown): Promise<T> {
    const end = Date.now() + PATIENCE_MS;
    const once = () =>
      fetch(`http://${this.address}/api${path}`, {
        method,
        headers: {
          Authorization: `Bearer ${this.token}`,
          "Content-Type": "application/json",
          ...(this.lease === null ? {} : { "Control-Lease": this.lease }),
        },
        ...(body === undefined ? {} : { body: JSON.stringify(body) }),
      });
    let response = await once();
    // A page that has just taken control has not shown its lease yet.
    while (response.status === 423 && Date.now() < end) {
      await new Promise((resolve) => setTimeout(resolve, 50));
      response = await once();
    }
    const text = await response.text();
    assert.ok(response.ok, `${method} ${path}: ${response.status} ${text}`);
    return (text === "" ? undefined : JSON.parse(text)) as T;
  }
}

let browser: Browser;

/** Has a browser for all tests of the file. */
export function withBrowser(): void {
  before(async () => {
    browser = await chromium.launch({ executablePath: CHROMIUM, args: FLAGS });
  });
  after(async () => {
    await browser.close();
  });
}

/** What an open page has said that nobody should have to read. */
export interface Window {
  page: Page;
  context: BrowserContext;
  complaints: string[];
}

/** Opens the page at `hash` in a window of its own, or an empty one. */
export async function open(server: Server, hash: string | null, viewport = DESK): Promise<Window> {
  const context = await browser.newContext({ viewport, colorScheme: "light", reducedMotion: "reduce" });
  context.setDefaultTimeout(PATIENCE_MS);
  const page = await context.newPage();
  const complaints: string[] = [];
  page.on("request", (request) => {
    const lease = request.headers()["control-lease"];
    if (lease !== undefined) server.lease = lease;
  });
  page.on("pageerror", (error) => complaints.push(String(error)));
  page.on("console", (message) => {
    if (message.type() === "error") complaints.push(message.text());
  });
  if (hash !== null) await page.goto(server.url + hash);
  return { page, context, complaints };
}

/** Opens a window, does something with it, and closes it; the browser has nothing to complain of. */
export async function look(
  server: Server,
  hash: string | null,
  act: (page: Page, window: Window) => Promise<void>,
  viewport = DESK,
): Promise<void> {
  const window = await open(server, hash, viewport);
  try {
    await act(window.page, window);
    assert.deepEqual(window.complaints, []);
  } catch (error) {
    await picture(window.page, `failed-${Date.now()}`);
    throw error;
  } finally {
    await window.context.close();
  }
}

/** The shown number of an element, without what makes it legible. */
export async function number(shown: Locator): Promise<number> {
  const text = (await shown.innerText()).replace("\u2212", "-").replace(/[\s\u2009]/g, "");
  return Number(/^[+-]?[\d.]+/.exec(text)?.[0] ?? Number.NaN);
}

/** Waits until something holds, and says what it was last if it never does. */
export async function until<T>(what: string, read: () => Promise<T>, holds: (value: T) => boolean): Promise<T> {
  const end = Date.now() + PATIENCE_MS;
  for (;;) {
    const value = await read();
    if (holds(value)) return value;
    if (Date.now() > end) assert.fail(`${what}: still ${JSON.stringify(value)}`);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

/** Takes a picture for the documents, where PULSETRAIN_PICTURES says. */
export async function picture(page: Page, name: string, colorScheme: "light" | "dark" = "light"): Promise<void> {
  if (PICTURES === undefined) return;
  await mkdir(PICTURES, { recursive: true });
  await page.emulateMedia({ colorScheme });
  await page.screenshot({ path: `${PICTURES}/${name}.png` });
  await page.emulateMedia({ colorScheme: "light" });
}
