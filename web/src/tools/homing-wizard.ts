// Homing wizard: see that the switches work and the motor turns the right way, choose how, look, go.

import { css, html, nothing } from "lit";
import type { AxisStatus, HomingMode, ParameterInfo } from "../api/contract.ts";
import { count } from "../state/format.ts";
import { Jog } from "../state/jog.ts";
import type { LiveEvent } from "../state/live.ts";
import "../ui/hold.ts";
import { lamp, lampStyles } from "../ui/lamp.ts";
import { base } from "../ui/styles.ts";
import { attempt, say } from "../ui/toast.ts";
import { named } from "./settings.ts";
import { Tool, toolStyles } from "./tool.ts";
import { settled } from "./waiting.ts";

/** The switches of an axis, and what they are called. */
const SWITCHES = [
  ["negative_limit", "Negative limit"],
  ["home", "Home"],
  ["positive_limit", "Positive limit"],
  ["index", "Index"],
] as const;
type Switch = (typeof SWITCHES)[number][0];

class HomingWizard extends Tool {
  static override properties = {
    ...Tool.properties,
    mode: { state: true },
    direction: { state: true },
    running: { state: true },
    result: { state: true },
  };
  declare mode: number;
  declare direction: 1 | -1;
  declare running: boolean;
  declare result: { ok: boolean; text: string } | null;

  protected override readonly watches: readonly LiveEvent[] = ["status"];
  /** Levels that each switch has been seen with. */
  readonly #seen = new Map<Switch, Set<boolean>>();
  #cancelled = false;
  #jog: Jog | null = null;

  static override styles = [
    base,
    toolStyles,
    lampStyles,
    css`
      button.primary {
        white-space: normal;
      }
      h2 span {
        display: inline-grid;
        place-items: center;
        width: 22px;
        height: 22px;
        margin-right: 6px;
        border-radius: 50%;
        background: var(--busy-bg);
        color: var(--busy);
      }
      .modes {
        display: grid;
        grid-template-columns: repeat(auto-fill, minmax(260px, 1fr));
        gap: 6px;
      }
      .mode {
        display: grid;
        grid-template-columns: auto 1fr;
        gap: 2px 8px;
        padding: 8px 10px;
        border: 1px solid var(--line);
        border-radius: var(--radius);
        color: var(--text);
        font-size: 13px;
        cursor: pointer;
      }
      .mode:has(:checked) {
        border-color: var(--accent);
        background: var(--busy-bg);
      }
      .mode small {
        grid-column: 2;
        color: var(--muted);
      }
      ul {
        margin: 0;
        padding: 0;
        list-style: none;
      }
      li {
        display: flex;
        gap: 8px;
        align-items: center;
        min-height: 28px;
      }
      pt-hold {
        width: 90px;
      }
    `,
  ];

  constructor() {
    super();
    this.mode = -1;
    this.direction = -1;
    this.running = false;
    this.result = null;
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.#cancelled = true;
  }

  /** Speeds and ways of homing, as far as the model has them. */
  protected override needs(): ParameterInfo[] {
    const { axis } = this;
    if (this.catalog.language === "tmcl") return named(this.catalog, [194, 195, 149, 12, 13].map((n) => `AP${n}.${axis}`));
    const ids = ["HSPD", "LSPD", "ACC", "HCA", "LCA"].flatMap((name) => [name + axis, name]);
    return named(this.catalog, [...ids, "RZ", `ZCNT${axis}`, "ZCNT"]);
  }

  get #status(): AxisStatus | undefined {
    return this.live.status?.axes[this.axis];
  }

  get #chosen(): HomingMode | undefined {
    return this.catalog.homing.find(({ id }) => id === this.mode) ?? this.catalog.homing[0];
  }

  #watch(status: AxisStatus | undefined): void {
    for (const [name] of SWITCHES) {
      const level = status?.[name];
      if (level === null || level === undefined) continue;
      this.#seen.set(name, (this.#seen.get(name) ?? new Set()).add(level));
    }
  }

  #jogTo(direction: 1 | -1): void {
    this.#jog = new Jog(this.api, this.live, this.axis);
    this.#jog.begin(direction);
  }

  async #go(mode: HomingMode, direction: 1 | -1): Promise<void> {
    const { axis, device } = this;
    this.running = true;
    this.#cancelled = false;
    this.result = null;
    const done = await attempt(async () => {
      await this.api.act(device.name, { do: "home", axis, mode: mode.id, direction });
      const end = await settled(this.api, device.name, axis, () => this.#cancelled);
      const ok = end.error === null && !this.#cancelled;
      const text = ok
        ? `The axis rests at ${count(end.position)} ${this.catalog.units.position}.`
        : (end.error ?? "Stopped before the end.");
      this.result = { ok, text };
    });
    if (!done) this.result = { ok: false, text: "Homing was not done." };
    this.running = false;
  }

  async #stop(): Promise<void> {
    this.#cancelled = true;
    await attempt(() => this.api.stop(this.device.name));
  }

  override render() {
    const status = this.#status;
    this.#watch(status);
    const mode = this.#chosen;
    if (!mode) return html`<p class="muted">This controller has no homing.</p>`;
    const ways = mode.directions.map((sign) => (sign === "+" ? 1 : -1) as 1 | -1);
    const direction = ways.includes(this.direction) ? this.direction : (ways[0] ?? -1);
    return html`
      ${this.#switches(status)} ${this.#turning(status)} ${this.#modes(mode, ways, direction)}
      ${this.#look(status)} ${this.#start(status, mode, direction)}
    `;
  }

  #heading(number: number, text: string) {
    return html`<h2 class="grow"><span>${number}</span>${text}</h2>`;
  }

  #switches(status: AxisStatus | undefined) {
    return html`
      <section class="panel stack" aria-label="Switches">
        <div class="row">${this.#heading(1, "Do the switches work?")} ${this.picker()}</div>
        <p class="text">Press each switch by hand, or in the tab I/O, and see its lamp go on and off.</p>
        <ul>
          ${SWITCHES.filter(([name]) => status?.[name] !== null && status?.[name] !== undefined).map(([name, label]) => {
            const seen = this.#seen.get(name)?.size === 2;
            return html`
              <li>
                ${lamp(label, status?.[name], label)}
                <span class="badge ${seen ? "ok" : ""}">${seen ? "works" : "not seen to change"}</span>
              </li>
            `;
          })}
        </ul>
      </section>
    `;
  }

  #turning(status: AxisStatus | undefined) {
    const hold = (direction: 1 | -1, label: string, text: string) => html`
      <pt-hold
        label=${label}
        .disabled=${!this.usable || this.running}
        @begin=${() => this.#jogTo(direction)}
        @end=${() => this.#jog?.end()}
        >${text}</pt-hold
      >
    `;
    return html`
      <section class="panel stack" aria-label="Direction">
        ${this.#heading(2, "Does it turn the right way?")}
        <p class="text">Hold a button for a moment: plus must move the load towards the positive limit.</p>
        <div class="row">
          ${hold(-1, "Jog in negative direction", "◀ −")} ${hold(1, "Jog in positive direction", "+ ▶")}
          <span>Position <strong>${count(status?.position)}</strong></span>
          ${status?.encoder === null || status === undefined
            ? nothing
            : html`<span>Encoder <strong>${count(status.encoder)}</strong></span>`}
        </div>
      </section>
    `;
  }

  #modes(mode: HomingMode, ways: (1 | -1)[], direction: 1 | -1) {
    const { tried } = this;
    return html`
      <section class="panel stack" aria-label="Way of homing">
        ${this.#heading(3, "How?")}
        <div class="modes" role="radiogroup" aria-label="Way of homing">
          ${this.catalog.homing.map(
            (one) => html`
              <label class="mode">
                <input type="radio" name="mode" .checked=${one.id === mode.id} @change=${() => (this.mode = one.id)} />
                <strong>${one.id} ${one.name}</strong>
                <small>${one.text} <span class="muted">(${one.section})</span></small>
              </label>
            `,
          )}
        </div>
        <div class="row" role="radiogroup" aria-label="Direction of the search">
          ${ways.map(
            (way) => html`
              <label class="line">
                <input type="radio" name="way" .checked=${way === direction} @change=${() => (this.direction = way)} />
                begins in ${way > 0 ? "positive" : "negative"} direction
              </label>
            `,
          )}
        </div>
        <div class="fields">${this.needs().map((info) => this.trial(info))}</div>
        ${tried.length > 0
          ? html`<div class="row">
              <button class="primary" ?disabled=${!this.usable} @click=${() => this.#write()}>Write ${tried.length}</button>
              <button @click=${() => (this.values = { ...this.read })}>Undo</button>
            </div>`
          : nothing}
      </section>
    `;
  }

  async #write(): Promise<void> {
    await this.writeTried();
    if (this.tried.length === 0) say("Written");
  }

  /** What could be in the way. */
  #look(status: AxisStatus | undefined) {
    const item = (good: boolean, text: string, button: unknown = nothing) => html`
      <li><span class="badge ${good ? "ok" : "warn"}">${good ? "good" : "look"}</span>${text} ${good ? nothing : button}</li>
    `;
    const act = (text: string, action: Parameters<typeof this.api.act>[1]) => html`
      <button class="small" ?disabled=${!this.usable} @click=${() => attempt(() => this.api.act(this.device.name, action))}>
        ${text}
      </button>
    `;
    if (!status) return nothing;
    const { axis } = this;
    const power = status.enabled !== false;
    const unseen = SWITCHES.filter(([name]) => name !== "index" && this.#seen.get(name)?.size === 1).map(([, label]) => label);
    const on = SWITCHES.filter(([name]) => name !== "index" && status[name] === true).map(([, label]) => label);
    return html`
      <section class="panel stack" aria-label="Before it goes">
        ${this.#heading(4, "Is all well?")}
        <ul>
          ${item(power, power ? "The motor has power." : "The motor has no power.", act("Power on", { do: "power", axis, on: true }))}
          ${item(status.error === null, status.error ?? "No error.", act("Clear", { do: "clear_error", axis }))}
          ${item(status.speed === 0, status.speed === 0 ? "The axis rests." : "The axis moves.", act("Stop", { do: "stop", axis }))}
          ${item(unseen.length === 0, unseen.length === 0 ? "All switches were seen to work." : `Not seen to change: ${unseen.join(", ")}.`)}
          ${on.length === 0 ? item(true, "No switch is on.") : item(false, `On now: ${on.join(", ")}. The search begins there.`)}
        </ul>
      </section>
    `;
  }

  #start(status: AxisStatus | undefined, mode: HomingMode, direction: 1 | -1) {
    const ready = this.usable && this.tried.length === 0 && status?.error === null && status.enabled !== false;
    return html`
      <section class="panel stack" aria-label="Go">
        ${this.#heading(5, "Go")}
        <div class="row">
          ${this.running
            ? html`<button class="stop" @click=${() => this.#stop()}>Stop</button>`
            : html`<button class="primary" ?disabled=${!ready} @click=${() => this.#go(mode, direction)}>
                Home ${this.axis} by ${mode.name}, ${direction > 0 ? "positive" : "negative"}
              </button>`}
          <span class="badge ${this.running ? "busy" : ""}">${status?.state ?? ""}</span>
          <span>Position <strong>${count(status?.position)}</strong></span>
        </div>
        ${this.result === null
          ? nothing
          : html`<p role="status" class=${this.result.ok ? "" : "error-text"}>
              <span class="badge ${this.result.ok ? "ok" : "error"}">${this.result.ok ? "home" : "not home"}</span>
              ${this.result.text}
            </p>`}
      </section>
    `;
  }
}
customElements.define("pt-homing-wizard", HomingWizard);
