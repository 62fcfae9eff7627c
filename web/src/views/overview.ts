// Every controller of the server on a card, and the ways to add one.

import { LitElement, css, html, nothing } from "lit";
import { repeat } from "lit/directives/repeat.js";
import { type Api, reason } from "../api/client.ts";
import type { AxisStatus, Status, Summary } from "../api/contract.ts";
import type { Control } from "../state/control.ts";
import { count } from "../state/format.ts";
import { routeTo } from "../state/route.ts";
import { confirm } from "../ui/dialog.ts";
import { stateKind } from "../ui/state.ts";
import { base } from "../ui/styles.ts";
import { attempt } from "../ui/toast.ts";
import "./add.ts";

const LIST_MS = 2000;
const STATUS_MS = 400;
/** Cards whose state is asked for at a time. */
const AT_ONCE = 4;

class Overview extends LitElement {
  static override properties = {
    api: { attribute: false },
    control: { attribute: false },
    devices: { state: true },
    problem: { state: true },
    adding: { state: true },
    filter: { state: true },
  };
  declare api: Api;
  declare control: Control;
  declare devices: Summary[] | null;
  declare problem: string | null;
  declare adding: "bench" | "real" | null;
  declare filter: string;

  readonly #states = new Map<string, Status | null>();
  readonly #visible = new Set<string>();
  #listTimer = 0;
  #statusTimer = 0;
  readonly #seen = new IntersectionObserver((entries) => {
    for (const entry of entries) {
      const name = (entry.target as HTMLElement).dataset["name"]!;
      if (entry.isIntersecting) this.#visible.add(name);
      else this.#visible.delete(name);
    }
  });

  static override styles = [
    base,
    css`
      .top {
        margin: 8px 0 14px;
      }
      h1 {
        font-size: 18px;
      }
      .cards {
        display: grid;
        grid-template-columns: repeat(auto-fill, minmax(min(340px, 100%), 1fr));
        gap: 12px;
        padding: 0;
        margin: 0;
        list-style: none;
      }
      .card {
        display: flex;
        flex-direction: column;
        gap: 8px;
      }
      .card.lost {
        border-color: var(--error);
      }
      .head {
        display: flex;
        align-items: baseline;
        gap: 8px;
      }
      .head a {
        overflow: hidden;
        font-size: 16px;
        font-weight: 650;
        text-decoration: none;
        text-overflow: ellipsis;
      }
      .where {
        overflow: hidden;
        color: var(--muted);
        font-size: 12px;
        text-overflow: ellipsis;
        white-space: nowrap;
      }
      td,
      th {
        padding: 2px 6px;
      }
      td:first-child,
      th:first-child {
        padding-left: 0;
        width: 2.2em;
      }
      tr:last-child td {
        border-bottom: 0;
      }
      .foot {
        margin-top: auto;
      }
      input[type="search"] {
        width: 200px;
      }
    `,
  ];

  constructor() {
    super();
    this.devices = null;
    this.problem = null;
    this.adding = null;
    this.filter = "";
  }

  override connectedCallback(): void {
    super.connectedCallback();
    void this.#list();
    void this.#look();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    clearTimeout(this.#listTimer);
    clearTimeout(this.#statusTimer);
    this.#seen.disconnect();
  }

  async #list(): Promise<void> {
    clearTimeout(this.#listTimer);
    try {
      this.devices = await this.api.devices();
      this.problem = null;
    } catch (error) {
      this.problem = reason(error);
    }
    if (this.isConnected) this.#listTimer = window.setTimeout(() => void this.#list(), LIST_MS);
  }

  /** Asks for the states of the cards on the screen, a few at a time. */
  async #look(): Promise<void> {
    if (!document.hidden) {
      const names = (this.devices ?? []).map(({ name }) => name).filter((name) => this.#visible.has(name));
      const worker = async () => {
        for (let name = names.pop(); name !== undefined; name = names.pop()) {
          this.#states.set(name, await this.api.status(name).catch(() => null));
        }
      };
      await Promise.all(Array.from({ length: AT_ONCE }, worker));
      this.requestUpdate();
    }
    if (this.isConnected) this.#statusTimer = window.setTimeout(() => void this.#look(), STATUS_MS);
  }

  override updated(): void {
    this.#seen.disconnect();
    for (const card of this.renderRoot.querySelectorAll<HTMLElement>(".card")) this.#seen.observe(card);
  }

  override render() {
    const wanted = this.filter.toLowerCase();
    const devices = (this.devices ?? []).filter((device) =>
      `${device.name} ${device.title} ${device.model} ${device.endpoints.join(" ")}`.toLowerCase().includes(wanted),
    );
    return html`
      <div class="row top">
        <h1>Controllers</h1>
        <span class="muted">${this.devices ? this.devices.length : ""}</span>
        <div class="grow"></div>
        ${(this.devices?.length ?? 0) > 6
          ? html`<input type="search" aria-label="Find a controller" placeholder="Find…"
              @input=${(event: InputEvent) => (this.filter = (event.target as HTMLInputElement).value)} />`
          : nothing}
        <div class="row">
          <button @click=${() => (this.adding = "bench")}>Add virtual…</button>
          <button @click=${() => (this.adding = "real")}>Connect real…</button>
        </div>
      </div>
      ${this.problem ? html`<p class="panel error-text" role="alert">${this.problem}</p>` : nothing}
      <ul class="cards">
        ${repeat(devices, ({ name }) => name, (device) => this.#card(device))}
      </ul>
      ${this.devices?.length === 0 ? html`<p class="muted">There is none yet.</p>` : nothing}
      <pt-add .api=${this.api} .kind=${this.adding} @done=${this.#added} @close=${() => (this.adding = null)}></pt-add>
    `;
  }

  #added(): void {
    this.adding = null;
    void this.#list();
  }

  #card(device: Summary) {
    const status = this.#states.get(device.name) ?? null;
    const lost = device.link.state === "lost" ? device.link.reason : null;
    const busy = status?.programs.filter(({ state }) => state === "running").length ?? 0;
    return html`
      <li class="card panel ${lost ? "lost" : ""}" data-name=${device.name}>
        <div class="head">
          <a href=${routeTo(device.name)}>${device.name}</a>
          <span class="muted">${device.title}</span>
          <span class="grow"></span>
          <span class="badge">${device.kind}</span>
        </div>
        <div class="where" title=${device.endpoints.join("\n")}>${device.endpoints.join(" · ") || "no endpoint"}</div>
        ${device.link.state === "connecting" ? html`<p class="muted">Connecting…</p>` : nothing}
        ${lost ? html`<p class="error-text">Lost: ${lost}</p>` : nothing}
        ${status ? this.#axes(device, status) : nothing}
        ${status?.alarms.map((alarm) => html`<div class="error-text">⚠ ${alarm}</div>`)}
        <div class="row foot">
          <button class="small" @click=${() => attempt(() => this.api.stop(device.name), `Stop sent to ${device.name}`)}>
            ■ Stop
          </button>
          ${busy > 0 ? html`<span class="badge busy">${busy === 1 ? "program runs" : `${busy} programs run`}</span>` : nothing}
          <span class="grow"></span>
          ${device.removable
            ? html`<button class="small plain" aria-label="Remove ${device.name}" @click=${() => this.#remove(device)}>
                Remove
              </button>`
            : nothing}
        </div>
      </li>
    `;
  }

  #axes(device: Summary, status: Status) {
    return html`
      <table aria-label="Axes of ${device.name}">
        <thead>
          <tr><th>Axis</th><th class="number">Position</th><th class="number">Speed</th><th>State</th></tr>
        </thead>
        <tbody>
          ${device.axis_names.flatMap((name) => (status.axes[name] ? [[name, status.axes[name]] as const] : [])).map(
            ([name, axis]: readonly [string, AxisStatus]) => html`
              <tr>
                <td><strong>${name}</strong></td>
                <td class="number">${count(axis.position)}</td>
                <td class="number">${count(axis.speed)}</td>
                <td><span class="badge ${stateKind(axis)}">${axis.error ?? axis.state}</span></td>
              </tr>
            `,
          )}
        </tbody>
      </table>
    `;
  }

  async #remove(device: Summary): Promise<void> {
    const agreed = await confirm({
      heading: `Remove ${device.name}?`,
      text: device.kind === "virtual"
        ? "The virtual controller and its endpoints go away, with what its memory holds."
        : "The page forgets the controller; nothing is sent to it.",
      yes: "Remove",
      danger: true,
    });
    if (agreed && (await attempt(() => this.api.remove(device.name), `${device.name} removed`))) await this.#list();
  }
}
customElements.define("pt-overview", Overview);
