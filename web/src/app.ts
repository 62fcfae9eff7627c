// The frame: where one is, who has control, and the stop button.

import { LitElement, css, html, nothing } from "lit";
import { keyed } from "lit/directives/keyed.js";
import { Api } from "./api/client.ts";
import { Control } from "./state/control.ts";
import { type Route, parseRoute, routeTo } from "./state/route.ts";
import { type Theme, setTheme, theme } from "./state/theme.ts";
import { base } from "./ui/styles.ts";
import { attempt, say } from "./ui/toast.ts";
import { STOP } from "./ui/dialog.ts";
import "./views/controller.ts";
import "./views/overview.ts";

const TOKEN = "token";
const THEMES: [Theme, string][] = [
  ["system", "◐ system"],
  ["dark", "☾ dark"],
  ["light", "☀ light"],
];

/** The token of the address, which does not stay there, or of this tab's session. */
function takeToken(): string {
  const url = new URL(location.href);
  const given = url.searchParams.get(TOKEN);
  if (given !== null) {
    sessionStorage.setItem(TOKEN, given);
    url.searchParams.delete(TOKEN);
    history.replaceState(null, "", url);
  }
  return sessionStorage.getItem(TOKEN) ?? "";
}

class App extends LitElement {
  static override properties = { route: { state: true }, refused: { state: true } };
  declare route: Route;
  declare refused: boolean;

  #api = new Api(takeToken());
  #control: Control | null = null;

  static override styles = [
    base,
    css`
      header {
        position: sticky;
        top: 0;
        z-index: 10;
        display: flex;
        align-items: center;
        gap: 10px;
        padding: 6px 14px;
        background: var(--panel);
        border-bottom: 1px solid var(--line);
      }
      .brand {
        display: flex;
        align-items: center;
        gap: 8px;
        color: var(--text);
        font-weight: 700;
        text-decoration: none;
      }
      .brand img {
        display: block;
        width: 22px;
        height: 22px;
      }
      .crumb {
        font-size: 14px;
        font-weight: 400;
        overflow: hidden;
        color: var(--muted);
        text-overflow: ellipsis;
        white-space: nowrap;
      }
      .crumb strong {
        color: var(--text);
        font-weight: 600;
      }
      .theme {
        width: auto;
        min-height: 30px;
      }
      .content {
        max-width: 1560px;
        margin: 0 auto;
        padding: 8px 14px 24px;
      }
      .lease {
        display: flex;
        flex-wrap: wrap;
        align-items: center;
        gap: 8px 12px;
        padding: 6px 14px;
        background: var(--warn-bg);
        color: var(--warn);
        font-weight: 550;
      }
      form {
        max-width: 460px;
        margin: 12vh auto 0;
      }
      @media (max-width: 700px) {
        .brand span,
        .lease-mine {
          display: none;
        }
        header {
          padding: 6px 10px;
        }
        header button.stop {
          position: fixed;
          z-index: 20;
          right: 10px;
          bottom: 10px;
          left: 10px;
          min-height: 48px;
          font-size: 16px;
          box-shadow: 0 2px 14px rgb(0 0 0 / 0.35);
        }
        .content {
          padding: 4px 10px 76px;
        }
      }
    `,
  ];

  constructor() {
    super();
    this.route = parseRoute(location.hash);
    this.refused = !this.#api.hasToken;
    this.#begin();
    window.addEventListener("hashchange", () => {
      this.route = parseRoute(location.hash);
    });
    window.addEventListener(STOP, () => void this.#stop());
    // Whatever has the focus and whatever else Escape closes: it stops.
    window.addEventListener("keydown", (event) => {
      if (event.key === "Escape" && !event.repeat) void this.#stop();
    }, { capture: true });
  }

  #begin(): void {
    if (this.refused) return;
    this.#api.addEventListener("unauthorized", () => {
      this.refused = true;
    });
    this.#control = new Control(this.#api);
    this.#control.addEventListener("change", () => this.requestUpdate());
  }

  /** Stops the controller that is looked at; on the overview, all of them. */
  async #stop(): Promise<void> {
    if (this.refused) return;
    const { device } = this.route;
    await attempt(async () => {
      const names = device === null ? (await this.#api.devices()).map(({ name }) => name) : [device];
      const results = await Promise.allSettled(names.map((name) => this.#api.stop(name)));
      const failed = results.find((result) => result.status === "rejected");
      if (failed) throw failed.reason;
      say(device === null ? "Stop sent to every controller" : `Stop sent to ${device}`);
    });
  }

  override updated(): void {
    document.title = this.route.device ? `${this.route.device} – Pulsetrain` : "Pulsetrain";
  }

  override render() {
    const { device, tab } = this.route;
    return html`
      <header>
        <a class="brand" href=${routeTo(null)} aria-label="Pulsetrain, all controllers">
          <img src="/icon.svg" alt="" /><span>Pulsetrain</span>
        </a>
        ${device ? html`<h1 class="crumb">/ <strong>${device}</strong></h1>` : nothing}
        <div class="grow"></div>
        ${this.#leaseMine()}
        <select class="theme" aria-label="Colours" @change=${this.#pickTheme}>
          ${THEMES.map(
            ([name, label]) => html`<option value=${name} ?selected=${theme() === name}>${label}</option>`,
          )}
        </select>
        <button class="stop" title="Escape" aria-keyshortcuts="Escape" @click=${() => this.#stop()}>
          ■ ${device ? "STOP" : "STOP ALL"}
        </button>
      </header>
      ${this.#leaseOther()}
      <div class="content">
        ${this.refused ? this.#askToken() : device
          ? keyed(device, html`
              <pt-controller .api=${this.#api} .control=${this.#control} .name=${device} .tab=${tab}></pt-controller>
            `)
          : html`<pt-overview .api=${this.#api} .control=${this.#control}></pt-overview>`}
      </div>
      <pt-toasts></pt-toasts>
    `;
  }

  #pickTheme(event: Event): void {
    setTheme((event.target as HTMLSelectElement).value as Theme);
  }

  #leaseMine() {
    if (!this.#control?.mine) return nothing;
    return html`
      <span class="lease-mine badge ok">you have control</span>
      <button class="lease-mine small plain" @click=${() => attempt(() => this.#control!.release())}>Give back</button>
    `;
  }

  #leaseOther() {
    const control = this.#control;
    if (!control || control.mine || control.holder === null) return nothing;
    return html`
      <div class="lease" role="status">
        <span>${control.holder} has control. You can look, and stop.</span>
        <button class="small" @click=${() => attempt(() => control.take())}>Take over</button>
      </div>
    `;
  }

  #askToken() {
    return html`
      <form class="panel stack" @submit=${this.#submitToken}>
        <h2>Who are you?</h2>
        <p>
          Open the address that <code>pulsetrain serve</code> prints when it starts, or enter the token at its end.
        </p>
        <label>Token <input name="token" type="text" autocomplete="off" spellcheck="false" required /></label>
        <div class="row"><button class="primary">Open</button></div>
      </form>
    `;
  }

  #submitToken(event: SubmitEvent): void {
    event.preventDefault();
    const token = new FormData(event.target as HTMLFormElement).get("token");
    sessionStorage.setItem(TOKEN, String(token).trim());
    location.reload();
  }
}
customElements.define("pt-app", App);
