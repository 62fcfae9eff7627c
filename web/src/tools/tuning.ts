// StallGuard2 and CoolStep tuning: the load value live, and the parameters that decide what it means. (PD42-1140
// firmware manual, 7.2 and 7.3.)

import { css, html, nothing } from "lit";
import type { ParameterInfo } from "../api/contract.ts";
import { count, parseWhole } from "../state/format.ts";
import type { LiveEvent } from "../state/live.ts";
import { base } from "../ui/styles.ts";
import { attempt } from "../ui/toast.ts";
import { AP, coolStepRange, current32, judge, READINGS_A_STEP, type Readings, STEPS_A_READING, sum, thresholds } from "./load.ts";
import { named } from "./settings.ts";
import { Tool, toolStyles } from "./tool.ts";
import "./load-curve.ts";

/** Readings that are judged: those of the last seconds. */
const JUDGED_S = 3;
/** Between two looks at the current. */
const LOOK_MS = 400;
/** The speed that is proposed: half of a register. */
const SPEED = 1000;

class Tuning extends Tool {
  static override properties = {
    ...Tool.properties,
    speed: { state: true },
    free: { state: true },
    loaded: { state: true },
    current: { state: true },
  };
  declare speed: number;
  declare free: Readings | null;
  declare loaded: Readings | null;
  /** Axis parameter 180. */
  declare current: number | null;

  protected override readonly watches: readonly LiveEvent[] = ["status"];
  #timer = 0;

  static override styles = [
    base,
    toolStyles,
    css`
      .sliders {
        display: grid;
        grid-template-columns: repeat(auto-fill, minmax(270px, 1fr));
        gap: 10px 18px;
      }
      .slider {
        display: grid;
        grid-template-columns: 1fr auto;
        gap: 2px 8px;
        font-size: 13px;
        color: var(--text);
      }
      .slider input {
        grid-column: 1 / 3;
        width: 100%;
      }
      .slider .what {
        grid-column: 1 / 3;
        color: var(--muted);
        font-size: 12px;
      }
      ol {
        margin: 0;
        padding-left: 20px;
      }
      li {
        margin-bottom: 8px;
      }
      meter {
        width: 220px;
        height: 16px;
      }
    `,
  ];

  constructor() {
    super();
    this.speed = SPEED;
    this.free = null;
    this.loaded = null;
    this.current = null;
  }

  override connectedCallback(): void {
    super.connectedCallback();
    this.#timer = window.setInterval(() => void this.#look(), LOOK_MS);
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    clearInterval(this.#timer);
  }

  async #look(): Promise<void> {
    if (!this.active || !this.reachable) return;
    const current = await this.api.parameter(this.device.name, this.#id("actualCurrent")).catch(() => null);
    this.current = typeof current === "number" ? current : null;
  }

  #id(parameter: keyof typeof AP): string {
    return `AP${AP[parameter]}.${this.axis}`;
  }

  #value(parameter: keyof typeof AP): number {
    return Number(this.values[this.#id(parameter)] ?? 0);
  }

  protected override needs(): ParameterInfo[] {
    return named(this.catalog, (Object.keys(AP) as (keyof typeof AP)[]).map((name) => this.#id(name)));
  }

  /** The readings of the last seconds. */
  #readings(): Readings | null {
    const { samples } = this.live;
    if (!samples.has(this.axis, "load")) return null;
    const times = samples.time();
    const recent = samples.values(this.axis, "load").filter((_, n) => (times[n] ?? 0) > samples.last - JUDGED_S);
    return sum([...recent]);
  }

  async #turn(direction: 1 | -1): Promise<void> {
    await attempt(() => this.api.act(this.device.name, { do: "jog", axis: this.axis, direction, speed: this.speed }));
  }

  override render() {
    const axis = this.live.status?.axes[this.axis];
    const [start, hysteresis] = [this.#value("start"), this.#value("hysteresis")];
    const band = thresholds(start, hysteresis);
    const moving = axis !== undefined && axis.speed !== 0;
    return html`
      <section class="panel stack" aria-label="Load">
        <div class="row">
          <h2 class="grow">Load value</h2>
          <span class="large" aria-label="Load value">${count(axis?.load)}</span>
          <span class="muted">0 is a stall</span>
        </div>
        <pt-load-curve .live=${this.live} .axis=${this.axis} .active=${this.active} .thresholds=${band}></pt-load-curve>
        <div class="row end">
          <label>
            Speed [int]
            <input
              inputmode="numeric"
              autocomplete="off"
              .value=${String(this.speed)}
              @change=${(event: Event) => {
                const field = event.target as HTMLInputElement;
                const speed = parseWhole(field.value);
                if (speed !== null && speed > 0 && speed <= 2047) this.speed = speed;
                else field.value = String(this.speed);
              }}
            />
          </label>
          <button ?disabled=${!this.usable} @click=${() => this.#turn(-1)}>◀ Turn</button>
          <button ?disabled=${!this.usable} @click=${() => this.#turn(1)}>Turn ▶</button>
          <button class="stop" @click=${() => attempt(() => this.api.stop(this.device.name))}>Stop</button>
          <span class="muted">${axis?.state ?? ""}</span>
        </div>
      </section>
      ${this.#stallGuard(moving)} ${this.#coolStep(band)}
    `;
  }

  #stallGuard(moving: boolean) {
    const shown = (readings: Readings | null) =>
      readings === null
        ? nothing
        : html`<span class="muted">${count(readings.least)} to ${count(readings.most)}, mean ${count(Math.round(readings.mean))}</span>`;
    return html`
      <section class="panel stack" aria-label="StallGuard2">
        <h2>StallGuard2</h2>
        <ol class="text">
          <li>Let the motor turn at its working speed and without load. Begin with a threshold of 0.</li>
          <li>
            <span class="row">
              <button class="small" ?disabled=${!moving} @click=${() => (this.free = this.#readings())}>Take free</button>
              ${shown(this.free)}
            </span>
          </li>
          <li>Brake the shaft with the highest load that it must still move (virtual: the load in the tab I/O).</li>
          <li>
            <span class="row">
              <button class="small" ?disabled=${!moving} @click=${() => (this.loaded = this.#readings())}>Take loaded</button>
              ${shown(this.loaded)}
            </span>
          </li>
          <li>Move the threshold, and take both again: the reading shall be just above 0 at this load.</li>
        </ol>
        <p role="status"><strong>${judge(this.free, this.loaded)}</strong></p>
        <div class="sliders">
          ${this.#slider("threshold")} ${this.#slider("filter")}
          ${this.#slider("stopSpeed", (value) => (value === 0 ? "never stops" : `stops above ${value}`))}
        </div>
      </section>
    `;
  }

  #coolStep(band: [number, number] | null) {
    const [least, most] = coolStepRange(this.#value("maxCurrent"), this.#value("minimum"));
    const now = this.current === null ? null : this.current + 1;
    return html`
      <section class="panel stack" aria-label="CoolStep">
        <h2>CoolStep</h2>
        <p class="text">
          ${band === null
            ? "Off while the hysteresis start is 0. Raise it until the band lies where the load value is at the usual load."
            : `Below ${band[0]} the current grows, above ${band[1]} it falls, between ${least}/32 and ${most}/32 of the module's.`}
          Tune StallGuard2 first, and switch its filter on.
        </p>
        <div class="row">
          <span>Current now</span>
          <meter min="0" max="32" .value=${now ?? 0} aria-label="Current now"></meter>
          <strong>${now === null ? "–" : `${now}/32`}</strong>
        </div>
        <div class="sliders">
          ${this.#slider("start", (value) => (value === 0 ? "off" : `below ${32 * value}`))}
          ${this.#slider("hysteresis", () => (band ? `above ${band[1]}` : ""))}
          ${this.#slider("minimum", (value) => (value === 0 ? "a half" : "a quarter"))}
          ${this.#slider("down", (value) => `${READINGS_A_STEP[value] ?? "?"} readings a step`)}
          ${this.#slider("up", (value) => `${STEPS_A_READING[value] ?? "?"} steps a reading`)}
          ${this.#slider("coolStepSpeed", (value) => `above ${value}`)}
          ${this.#slider("slowCurrent", (value) => `${current32(value)}/32 below that speed`)}
          ${this.#slider("maxCurrent", (value) => `${current32(value)}/32`)}
        </div>
      </section>
    `;
  }

  /** A parameter to draw along; it is written when the slider is let go. */
  #slider(parameter: keyof typeof AP, words: (value: number) => string = () => "") {
    const id = this.#id(parameter);
    const info = this.catalog.parameters.find((other) => other.id === id);
    if (!info || this.values[id] === undefined) return nothing;
    const value = this.#value(parameter);
    const take = (event: Event) => Number((event.target as HTMLInputElement).value);
    return html`
      <label class="slider" title=${info.text}>
        <span>${info.name} <code>${id}</code></span>
        <strong>${value}</strong>
        <input
          type="range"
          min=${info.low ?? 0}
          max=${info.high ?? 0}
          .value=${String(value)}
          ?disabled=${!this.usable}
          @input=${(event: Event) => (this.values = { ...this.values, [id]: take(event) })}
          @change=${(event: Event) => this.write(id, take(event))}
        />
        <span class="what">${words(value)}</span>
      </label>
    `;
  }
}
customElements.define("pt-tuning", Tuning);
