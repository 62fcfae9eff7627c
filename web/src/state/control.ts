// Who has control. The first change that this page makes takes the lease if nobody has it; it is renewed while
// the page is open and given back when it closes.

import { type Api, ApiError } from "../api/client.ts";

const LOOK_MS = 2000;

export class Control extends EventTarget {
  /** Who holds the lease. */
  holder: string | null = null;
  /** Whether that is this page. */
  mine = false;
  /** How this page calls itself to others. */
  readonly name: string;
  readonly #api: Api;
  #taking: Promise<void> | null = null;

  constructor(api: Api) {
    super();
    this.#api = api;
    this.name = pageName();
    api.beforeChange = () => this.#ensure();
    api.addEventListener("locked", (event) => {
      api.lease = null;
      this.#set((event as CustomEvent<string | null>).detail, false);
    });
    window.addEventListener("pagehide", () => void this.release());
    void this.#look();
  }

  /** Takes control, from somebody else if need be. */
  async take(): Promise<void> {
    const { lease } = await this.#api.takeLease(this.name, true);
    this.#api.lease = lease;
    this.#set(this.name, true);
  }

  /** Gives control back. */
  async release(): Promise<void> {
    if (this.#api.lease === null) return;
    const dropped = this.#api.dropLease();
    this.#api.lease = null;
    this.#set(null, false);
    await dropped.catch(() => undefined);
  }

  async #ensure(): Promise<void> {
    if (this.holder !== null && !this.mine) return;
    this.#taking ??= this.#takeFree().finally(() => {
      this.#taking = null;
    });
    await this.#taking;
  }

  async #takeFree(): Promise<void> {
    try {
      const { lease } = await this.#api.takeLease(this.name, false);
      this.#api.lease = lease;
      this.#set(this.name, true);
    } catch (error) {
      // Somebody was faster: the request itself says so.
      if (!(error instanceof ApiError)) throw error;
    }
  }

  async #look(): Promise<void> {
    const { lease } = this.#api;
    try {
      if (lease !== null) await this.#api.renewLease();
      const { holder, mine } = await this.#api.leaseState();
      // Control that was taken or given back meanwhile is newer than this answer.
      if (lease === this.#api.lease) {
        if (!mine) this.#api.lease = null;
        this.#set(holder, mine);
      }
    } catch (error) {
      if (error instanceof ApiError && error.status !== 0 && lease === this.#api.lease) this.#api.lease = null;
    }
    window.setTimeout(() => void this.#look(), LOOK_MS);
  }

  #set(holder: string | null, mine: boolean): void {
    if (holder === this.holder && mine === this.mine) return;
    this.holder = holder;
    this.mine = mine;
    this.dispatchEvent(new Event("change"));
  }
}

/** A name that a colleague at another screen can tell apart. */
function pageName(): string {
  const stored = sessionStorage.getItem("page-name");
  if (stored) return stored;
  const agent = navigator.userAgent;
  const browser = ["Firefox", "Edg", "Chrome", "Safari"].find((name) => agent.includes(name)) ?? "Browser";
  const system =
    ["Android", "iPhone", "iPad", "Windows", "Mac", "Linux"].find((name) => agent.includes(name)) ?? "computer";
  const mark = Math.floor(Math.random() * 0x1000).toString(16).padStart(3, "0");
  const name = `${browser === "Edg" ? "Edge" : browser} on ${system} (${mark})`;
  sessionStorage.setItem("page-name", name);
  return name;
}
