// StepNLoop ratio finder: moves there and back and compares what the motor was told with what the encoder counted.

import { css, html, nothing } from "lit";
import type { ParameterInfo, Role } from "../api/contract.ts";
import { count, decimal, parseWhole } from "../state/format.ts";
import type { LiveEvent } from "../state/live.ts";
import { base } from "../ui/styles.ts";
import { attempt, say } from "../ui/toast.ts";
import { named } from "./settings.ts";
import { ADVICE, ratio, type Trial } from "./stepnloop.ts";
import { Tool, toolStyles } from "./tool.ts";
import { settled } from "./waiting.ts";

/** Moves that are made: there and back, twice. */
const WAYS = [1, -1, 1, -1];
const MAX_PULSES = 1_000_000;

class RatioFinder extends Tool {
  static override properties = {
    ...Tool.properties,
    pulses: { state: true },
    trials: { state: true },
    running: { state: true },
  };
  declare pulses: number;
  declare trials: Trial[];
  declare running: boolean;
  protected override readonly watches: readonly LiveEvent[] = ["status"];
  #cancelled = false;

  static override styles = [
    base,
    toolStyles,
    css`
      table {
        max-width: 420px;
      }
    `,
  ];

  constructor() {
    super();
    this.pulses = 1000;
    this.trials = [];
    this.running = false;
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.#cancelled = true;
  }

  get #ids() {
    const id = (what: Role) => this.catalog.parameters.find(({ role, axis }) => role === what && axis === this.axis)?.id ?? "";
    return { loop: id("closed_loop"), ratio: id("closed_loop_ratio") };
  }

  protected override needs(): ParameterInfo[] {
    return named(this.catalog, [this.#ids.loop, this.#ids.ratio]);
  }

  async #find(): Promise<void> {
    this.running = true;
    this.#cancelled = false;
    this.trials = [];
    await attempt(() => this.#measure());
    this.running = false;
  }

  async #measure(): Promise<void> {
    const { name } = this.device;
    const { axis } = this;
    // With the loop closed the controller would correct by the very ratio that is looked for.
    if (this.read[this.#ids.loop] !== 0 && !(await this.write(this.#ids.loop, 0))) return;
    for (const way of WAYS) {
      const from = await settled(this.api, name, axis, () => this.#cancelled);
      await this.api.act(name, { do: "move", targets: { [axis]: way * this.pulses }, relative: true });
      const to = await settled(this.api, name, axis, () => this.#cancelled);
      if (this.#cancelled) return;
      if (to.error !== null) throw new Error(`Axis ${axis} stopped: ${to.error}.`);
      if (to.encoder === null || from.encoder === null) throw new Error("This axis has no encoder.");
      const trial = { pulses: to.position - from.position, counts: to.encoder - from.encoder };
      this.trials = [...this.trials, trial];
      if (trial.pulses !== way * this.pulses) throw new Error("The axis did not go all the way; was it stopped?");
    }
  }

  #power(): Promise<boolean> {
    return attempt(() => this.api.act(this.device.name, { do: "power", axis: this.axis, on: true }));
  }

  async #stop(): Promise<void> {
    this.#cancelled = true;
    await attempt(() => this.api.stop(this.device.name));
  }

  async #write(found: number): Promise<void> {
    if (await this.write(this.#ids.ratio, found)) say(`${this.#ids.ratio}=${found.toFixed(3)}; store it to keep it.`);
  }

  override render() {
    const done = this.trials.length === WAYS.length;
    const found = done ? ratio(this.trials) : null;
    const axis = this.live.status?.axes[this.axis];
    return html`
      <section class="panel stack" aria-label="StepNLoop ratio">
        <div class="row">
          <h2 class="grow">StepNLoop ratio</h2>
          ${this.picker()}
        </div>
        <p class="text">
          The axis moves forward and back twice with StepNLoop off. Pulses divided by encoder counts are the ratio.
          Choose a way that is free and long enough: with more pulses the ratio gets finer.
        </p>
        <div class="row end">
          <label>
            Distance [pulses]
            <input
              inputmode="numeric"
              autocomplete="off"
              .value=${String(this.pulses)}
              @change=${(event: Event) => {
                const field = event.target as HTMLInputElement;
                const pulses = parseWhole(field.value);
                if (pulses !== null && pulses !== 0 && Math.abs(pulses) <= MAX_PULSES) this.pulses = pulses;
                else field.value = String(this.pulses);
              }}
            />
          </label>
          ${this.running
            ? html`<button class="stop" @click=${() => this.#stop()}>Stop</button>`
            : html`<button class="primary" ?disabled=${!this.usable || axis?.enabled === false} @click=${() => this.#find()}>
                Move and measure
              </button>`}
          ${axis?.enabled === false
            ? html`
                <span class="warn-text">The motor has no power.</span>
                <button ?disabled=${!this.usable} @click=${() => this.#power()}>Power on</button>
              `
            : nothing}
          <span class="muted">Now: ${this.#ids.loop}=${this.values[this.#ids.loop] ?? "–"}, ${this.#ids.ratio}=${this.values[this.#ids.ratio] ?? "–"}</span>
        </div>
        ${this.trials.length > 0 ? this.#table() : nothing}
        ${found === null
          ? nothing
          : found.ok
            ? html`
                <div class="row" role="status">
                  <span class="large">${found.ratio.toFixed(3)}</span>
                  <span class="muted">pulses a count; ${decimal(found.exact, 6)} exactly, single moves differ by ${decimal(found.spread, 4)}</span>
                  <button class="primary" ?disabled=${!this.usable} @click=${() => this.#write(found.ratio)}>
                    Write ${this.#ids.ratio}
                  </button>
                </div>
              `
            : html`<p class="error-text" role="alert">${ADVICE[found.reason]}</p>`}
      </section>
    `;
  }

  #table() {
    return html`
      <table aria-label="Moves">
        <thead>
          <tr>
            <th class="number">Pulses</th>
            <th class="number">Counts</th>
            <th class="number">Ratio</th>
          </tr>
        </thead>
        <tbody>
          ${this.trials.map(
            ({ pulses, counts }) => html`
              <tr>
                <td class="number">${count(pulses)}</td>
                <td class="number">${count(counts)}</td>
                <td class="number">${decimal(pulses / counts, 4)}</td>
              </tr>
            `,
          )}
        </tbody>
      </table>
    `;
  }
}
customElements.define("pt-ratio-finder", RatioFinder);
