// A controller's page: its tabs, and what they share.

import { LitElement, css, html, nothing } from "lit";
import { type Api, reason } from "../api/client.ts";
import type { Catalog, Summary } from "../api/contract.ts";
import type { Control } from "../state/control.ts";
import { LiveStore } from "../state/live.ts";
import { routeTo } from "../state/route.ts";
import { base } from "../ui/styles.ts";
import type { Tab } from "./tab.ts";
import { TABS, type TabRow } from "./tabs.ts";

const RETRY_MS = 2000;

class Controller extends LitElement {
  static override properties = {
    api: { attribute: false },
    control: { attribute: false },
    name: { type: String },
    tab: { type: String },
    device: { state: true },
    problem: { state: true },
    loaded: { state: true },
  };
  declare api: Api;
  declare control: Control;
  declare name: string;
  declare tab: string | null;
  declare device: Summary | null;
  declare problem: string | null;
  declare loaded: string | null;

  #catalog: Catalog | null = null;
  #live: LiveStore | null = null;
  readonly #elements = new Map<string, Tab>();
  #timer = 0;
  readonly #refresh = () => this.requestUpdate();
  readonly #connection = () => {
    this.requestUpdate();
    if (!this.#live?.connected) void this.#isGone();
  };

  static override styles = [
    base,
    css`
      nav {
        display: flex;
        gap: 2px;
        margin-bottom: var(--gap);
        border-bottom: 1px solid var(--line);
        overflow-x: auto;
        scrollbar-width: none;
      }
      nav a {
        padding: 8px 13px;
        border-bottom: 2px solid transparent;
        color: var(--muted);
        text-decoration: none;
        font-weight: 550;
        white-space: nowrap;
      }
      nav a:hover {
        color: var(--text);
      }
      nav a:focus-visible {
        outline-offset: -2px;
      }
      nav a[aria-current] {
        border-bottom-color: var(--accent);
        color: var(--text);
      }
      .banner {
        display: flex;
        align-items: center;
        gap: 10px;
        margin-bottom: var(--gap);
        padding: 8px 12px;
        border-radius: var(--radius);
        background: var(--error-bg);
        color: var(--error);
        font-weight: 550;
      }
      .stale {
        opacity: 0.65;
      }
      .waiting {
        padding: 40px 0;
        text-align: center;
        color: var(--muted);
      }
    `,
  ];

  constructor() {
    super();
    this.name = "";
    this.tab = null;
    this.device = null;
    this.problem = null;
    this.loaded = null;
  }

  override connectedCallback(): void {
    super.connectedCallback();
    void this.#open();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    clearTimeout(this.#timer);
    this.#live?.close();
  }

  async #open(): Promise<void> {
    try {
      const devices = await this.api.devices();
      const device = devices.find((one) => one.name === this.name);
      if (!device) {
        this.problem = `There is no controller “${this.name}”.`;
        return;
      }
      this.#catalog = await this.api.catalog(device.model);
      if (!this.isConnected) return;
      this.#live = new LiveStore(this.api, this.name);
      this.#live.addEventListener("connection", this.#connection);
      this.#live.addEventListener("link", this.#refresh);
      this.#live.open();
      this.problem = null;
      this.device = device;
    } catch (error) {
      this.problem = reason(error);
      if (this.isConnected) this.#timer = window.setTimeout(() => void this.#open(), RETRY_MS);
    }
  }

  /** Whether the server is there and the controller is not: then nobody comes back. */
  async #isGone(): Promise<void> {
    const devices = await this.api.devices().catch(() => null);
    if (!devices || devices.some((one) => one.name === this.name)) return;
    this.#live?.close();
    this.problem = `“${this.name}” has been removed.`;
  }

  override updated(): void {
    if (!this.device) return;
    const row = this.#row();
    if (row && !this.#elements.has(row.id)) void this.#load(row);
    for (const [id, element] of this.#elements) {
      element.hidden = id !== row?.id;
      element.active = id === row?.id;
    }
  }

  #row(): TabRow | undefined {
    const rows = this.#rows();
    return rows.find((row) => row.id === this.tab) ?? rows[0];
  }

  #rows(): TabRow[] {
    const [device, catalog] = [this.device, this.#catalog];
    if (!device || !catalog) return [];
    return TABS.filter((row) => row.fits?.(device, catalog) ?? true);
  }

  async #load(row: TabRow): Promise<void> {
    try {
      await row.load();
    } catch {
      this.problem = "A part of the page could not be loaded; reload the page.";
      return;
    }
    if (this.#elements.has(row.id)) return;
    const element = document.createElement(row.element) as Tab;
    Object.assign(element, {
      device: this.device,
      catalog: this.#catalog,
      live: this.#live,
      api: this.api,
      control: this.control,
      active: true,
    });
    this.#elements.set(row.id, element);
    this.loaded = row.id;
    this.renderRoot.querySelector("main")!.append(element);
    this.requestUpdate();
  }

  override render() {
    if (!this.device) {
      return html`<p class="waiting" role="status">${this.problem ?? "Loading…"}</p>`;
    }
    const row = this.#row();
    return html`
      <nav aria-label="Parts of ${this.name}">
        ${this.#rows().map(
          ({ id, title }) => html`
            <a href=${routeTo(this.name, id)} aria-current=${id === row?.id ? "page" : nothing}>${title}</a>
          `,
        )}
      </nav>
      ${this.#banner()}
      <main class=${this.#live?.connected ? "" : "stale"}></main>
    `;
  }

  #banner() {
    const live = this.#live!;
    const text = this.problem
      ? this.problem
      : !live.connected
        ? "The server does not answer. What is shown is old; the page connects again by itself."
        : live.link.state === "lost"
          ? `The controller does not answer: ${live.link.reason}`
          : null;
    return text ? html`<div class="banner" role="alert">${text}</div>` : nothing;
  }
}
customElements.define("pt-controller", Controller);
