// Unit calculator: what a number of the controller is in turns and millimetres, and the other way round.

import { css, html, nothing, type PropertyValues } from "lit";
import type { ParameterInfo } from "../api/contract.ts";
import { decimal, parseNumber } from "../state/format.ts";
import { base } from "../ui/styles.ts";
import { say } from "../ui/toast.ts";
import { rampRange, windowOf } from "./pps.ts";
import { counting, deciding, microsteps } from "./settings.ts";
import { bestDivisors, externalPrescaler, sensostepPrescaler, type Divisors } from "./tmc429.ts";
import { Tool, toolStyles } from "./tool.ts";
import { convert, type Counting, type Drive, type Quantity, readable, type Unit, units } from "./units.ts";

const QUANTITIES: Quantity[] = ["position", "speed", "acceleration"];

/** A number that was entered, in a unit; all others follow. */
interface Entry {
  unit: string;
  value: number;
}

class Calculator extends Tool {
  static override properties = {
    ...Tool.properties,
    drive: { state: true },
    divisors: { state: true },
    ratio: { state: true },
    entries: { state: true },
    ramp: { state: true },
    counts: { state: true },
  };
  declare drive: Drive;
  declare divisors: Divisors;
  /** Pulses of an encoder count. */
  declare ratio: number;
  declare entries: Record<Quantity, Entry>;
  /** Low speed, high speed, and milliseconds from one to the other. */
  declare ramp: { low: number; high: number; ms: number };
  /** Counts of an external encoder in a turn. */
  declare counts: number;

  static override styles = [
    base,
    toolStyles,
    css`
      .quantities {
        display: grid;
        grid-template-columns: repeat(auto-fit, minmax(250px, 1fr));
        gap: var(--gap);
      }
      td:first-child {
        width: 60%;
      }
      td input {
        width: 100%;
        text-align: right;
      }
      td {
        vertical-align: middle;
      }
      h2 {
        margin-bottom: 6px;
      }
      .off input {
        border-color: var(--error);
      }
    `,
  ];

  constructor() {
    super();
    this.drive = { fullSteps: 200, microsteps: 256, mmPerTurn: 5 };
    this.divisors = { pulse: 2, ramp: 3 };
    this.ratio = 1;
    this.entries = {
      position: { unit: "turns", value: 1 },
      speed: { unit: "rpm", value: 60 },
      acceleration: { unit: "turns", value: 10 },
    };
    this.ramp = { low: 100, high: 1000, ms: 300 };
    this.counts = 4000;
  }

  get #chip(): boolean {
    return this.catalog.language === "tmcl";
  }

  protected override needs(): ParameterInfo[] {
    return deciding(this.catalog, this.axis);
  }

  override willUpdate(changed: PropertyValues): void {
    super.willUpdate(changed);
    if (changed.has("device") && this.device) this.drive = load(this.device.name, this.#chip);
    if (changed.has("values")) this.#take();
  }

  /** Takes over what the controller says. */
  #take(): void {
    const steps = microsteps(this.catalog, this.axis, this.values);
    if (steps !== null) this.drive = { ...this.drive, microsteps: steps };
    const { divisors, pulsesPerCount } = counting(this.catalog, this.axis, this.values);
    if (divisors && Object.keys(this.values).length > 0) this.divisors = divisors;
    if (pulsesPerCount) this.ratio = pulsesPerCount;
    const own = (name: string) => Number(this.values[name + this.axis]) || Number(this.values[name]);
    const [low, high, ms] = ["LSPD", "HSPD", "ACC"].map(own);
    if (low && high && ms) this.ramp = { low, high, ms };
  }

  get #counting(): Counting {
    return this.#chip ? { divisors: this.divisors } : { pulsesPerCount: this.ratio };
  }

  #setDrive(change: Partial<Drive>): void {
    this.drive = { ...this.drive, ...change };
    localStorage.setItem(key(this.device.name), JSON.stringify(this.drive));
  }

  /** Pulses of what was entered; the drive may have changed since, the entry has not. */
  #pulses(quantity: Quantity): number {
    const { unit, value } = this.entries[quantity];
    const list = units(quantity, this.drive, this.#counting);
    return value * (list.find(({ id }) => id === unit)?.pulses ?? 1);
  }

  override render() {
    return html`
      <section class="panel stack" aria-label="Drive">
        <div class="row">
          <h2 class="grow">Drive</h2>
          ${this.picker()}
          <button class="small" ?disabled=${!this.reachable} @click=${() => this.refresh()}>Take from the controller</button>
        </div>
        <div class="fields">
          ${this.#number("Full steps a turn", this.drive.fullSteps, 1, 100_000, (fullSteps) => this.#setDrive({ fullSteps }))}
          ${this.#number(
            this.#chip ? "Microsteps (AP 140)" : "Microsteps of the drive",
            this.drive.microsteps,
            1,
            4096,
            (microsteps) => this.#setDrive({ microsteps }),
          )}
          ${this.#number("Millimetres a turn", this.drive.mmPerTurn, 0, 1e6, (mmPerTurn) => this.#setDrive({ mmPerTurn }))}
          ${this.#chip
            ? html`
                ${this.#number("Pulse divisor (AP 154)", this.divisors.pulse, 0, 13, (pulse) => {
                  this.divisors = { ...this.divisors, pulse: Math.round(pulse) };
                })}
                ${this.#number("Ramp divisor (AP 153)", this.divisors.ramp, 0, 13, (ramp) => {
                  this.divisors = { ...this.divisors, ramp: Math.round(ramp) };
                })}
              `
            : this.#number("Pulses a count (SLR)", this.ratio, 0.001, 999.999, (ratio) => (this.ratio = ratio))}
        </div>
      </section>
      <div class="quantities">${QUANTITIES.map((quantity) => this.#quantity(quantity))}</div>
      ${this.#chip ? this.#advice() : this.#ramp()}
    `;
  }

  #number(label: string, value: number, low: number, high: number, set: (value: number) => void) {
    return html`
      <label>
        ${label}
        <input
          inputmode="decimal"
          autocomplete="off"
          .value=${String(value)}
          @change=${(event: Event) => {
            const field = event.target as HTMLInputElement;
            const entered = parseNumber(field.value);
            if (entered !== null && entered >= low && entered <= high) set(entered);
            else {
              say(`${label}: ${low} to ${high}.`, "error");
              field.value = String(value);
            }
          }}
        />
      </label>
    `;
  }

  #quantity(quantity: Quantity) {
    const list = units(quantity, this.drive, this.#counting);
    const { unit: chosen, value } = this.entries[quantity];
    const from = list.find(({ id }) => id === chosen) ?? list[0];
    if (!from) return nothing;
    return html`
      <section class="panel" aria-label=${quantity}>
        <h2>${quantity[0]?.toUpperCase()}${quantity.slice(1)}</h2>
        <table aria-label="The same ${quantity} in each unit">
          <tbody>
            ${convert(value, from, list).map(({ unit, shown, exact, fits }) => {
              // What is being typed stays as it was typed.
              const text = unit === from && Number.isFinite(exact) ? String(value) : readable(shown);
              return html`
                <tr class=${fits ? "" : "off"}>
                  <td>
                    <input
                      aria-label="${unit.name}, ${unit.label}"
                      aria-invalid=${fits ? "false" : "true"}
                      inputmode="decimal"
                      autocomplete="off"
                      .value=${text}
                      @input=${(event: Event) => this.#enter(quantity, unit, event.target as HTMLInputElement)}
                    />
                  </td>
                  <td>
                    ${unit.label}
                    ${fits ? nothing : html`<div class="error-text">${readable(exact)} is out of range</div>`}
                  </td>
                </tr>
              `;
            })}
          </tbody>
        </table>
      </section>
    `;
  }

  #enter(quantity: Quantity, unit: Unit, field: HTMLInputElement): void {
    const value = parseNumber(field.value);
    field.setAttribute("aria-invalid", String(value === null));
    if (value !== null) this.entries = { ...this.entries, [quantity]: { unit: unit.id, value } };
  }

  /** Divisors and prescalers for what was entered. */
  #advice() {
    const best = bestDivisors(Math.abs(this.#pulses("speed")), Math.abs(this.#pulses("acceleration")));
    const { microsteps: steps, fullSteps } = this.drive;
    const taken = best.pulse === this.divisors.pulse && best.ramp === this.divisors.ramp;
    return html`
      <section class="panel stack" aria-label="Divisors and prescalers">
        <h2>Divisors and prescalers</h2>
        <p class="text">
          Taking this speed and this acceleration as the highest that are needed, these divisors leave the most of the
          registers (firmware manual, 6.1.3).
        </p>
        <div class="row">
          <span>Pulse divisor <strong>${best.pulse}</strong>, ramp divisor <strong>${best.ramp}</strong></span>
          <button class="small" ?disabled=${taken} @click=${() => (this.divisors = best)}>Calculate with them</button>
          <button class="small" ?disabled=${!this.usable} @click=${() => this.#writeDivisors(best)}>Write to the controller</button>
        </div>
        <div class="row end">
          <span>SensOstep prescaler (AP 210) <strong>${sensostepPrescaler(steps, fullSteps)}</strong></span>
          ${this.#number("Counts a turn, external encoder", this.counts, 1, 1e7, (counts) => (this.counts = counts))}
          <span>External prescaler (AP 217) <strong>${externalPrescaler(steps, fullSteps, this.counts)}</strong></span>
        </div>
      </section>
    `;
  }

  async #writeDivisors({ pulse, ramp }: Divisors): Promise<void> {
    const written = (await this.write(`AP154.${this.axis}`, pulse)) && (await this.write(`AP153.${this.axis}`, ramp));
    if (written) say("Divisors written; speeds and accelerations in internal units mean other speeds now.");
  }

  /** Ramps in milliseconds: what acceleration they are, and how long they may be. */
  #ramp() {
    const { low, high, ms } = this.ramp;
    const set = (change: Partial<typeof this.ramp>) => (this.ramp = { ...this.ramp, ...change });
    const window = windowOf(this.catalog.speed_windows, high);
    const [least, longest] = window ? rampRange(window, low, high) : [0, 0];
    const pps2 = ((high - low) * 1000) / ms;
    return html`
      <section class="panel stack" aria-label="Ramp">
        <h2>Ramp</h2>
        <div class="fields">
          ${this.#number("Low speed [pps]", low, 1, 1e7, (low) => set({ low }))}
          ${this.#number("High speed [pps]", high, 1, 1e7, (high) => set({ high }))}
          ${this.#number("Time [ms]", ms, 1, 1e9, (ms) => set({ ms }))}
          ${this.#number("Acceleration [pps²]", Number(pps2.toPrecision(6)), 1e-6, 1e12, (pps2) =>
            set({ ms: Math.max(Math.round(((high - low) * 1000) / pps2), 1) }),
          )}
        </div>
        ${window
          ? html`<p class="text">
              Speed window ${window.number} (SSPDM), ${window.from_pps} to ${window.to_pps} pps: ramps take ${least} to
              ${longest} ms between these speeds, over ${decimal((((low + high) / 2) * ms) / 1000, 0)} pulses with
              ${ms} ms.
            </p>`
          : nothing}
      </section>
    `;
  }
}
customElements.define("pt-calculator", Calculator);

const key = (device: string) => `drive ${device}`;

/** The drive that was last entered for a controller. */
function load(device: string, chip: boolean): Drive {
  const usual: Drive = { fullSteps: 200, microsteps: chip ? 256 : 10, mmPerTurn: 5 };
  try {
    const stored = JSON.parse(localStorage.getItem(key(device)) ?? "{}") as Partial<Record<keyof Drive, unknown>>;
    const get = (name: keyof Drive) => (typeof stored[name] === "number" ? stored[name] : usual[name]);
    return { fullSteps: get("fullSteps"), microsteps: get("microsteps"), mmPerTurn: get("mmPerTurn") };
  } catch {
    return usual;
  }
}
