// Faults on purpose: what is wrong with a virtual controller, its supply and its wires; and its power.

import { css, html, nothing } from "lit";
import { type Fault, type FaultKind, reason } from "../api/client.ts";
import { parseNumber } from "../state/format.ts";
import { confirm } from "../ui/dialog.ts";
import { base } from "../ui/styles.ts";
import { attempt, say } from "../ui/toast.ts";
import { Tab } from "./tab.ts";

const ASK_MS = 1000;
/** Keys of a fault that are words; all others are numbers. */
const WORDS = ["pin", "axis", "port", "way", "bytes"];
/** What stands beside a number's name. */
const UNITS: Record<string, string> = { ms: "ms", volts: "V", at: "s", duration: "s", pulses: "pulses", load: "of pull-out torque", rate: "0 to 1" };

class Faults extends Tab {
  static override properties = {
    ...Tab.properties,
    faults: { state: true },
    kinds: { state: true },
    kind: { state: true },
    problem: { state: true },
  };
  declare faults: Fault[];
  declare kinds: FaultKind[];
  declare kind: string;
  declare problem: string | null;
  #timer = 0;

  static override styles = [
    base,
    css`
      .fields {
        display: grid;
        grid-template-columns: repeat(auto-fill, minmax(110px, 1fr));
        gap: 8px;
      }
      .about {
        font-size: 13px;
        color: var(--muted);
      }
    `,
  ];

  constructor() {
    super();
    this.faults = [];
    this.kinds = [];
    this.kind = "";
    this.problem = null;
  }

  override connectedCallback(): void {
    super.connectedCallback();
    void this.#ask();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    clearTimeout(this.#timer);
  }

  async #ask(): Promise<void> {
    clearTimeout(this.#timer);
    if (this.active && !document.hidden) {
      try {
        if (this.kinds.length === 0) {
          this.kinds = await this.api.faultKinds();
          this.kind ||= this.kinds[0]?.name ?? "";
        }
        this.faults = await this.api.faults(this.device.name);
        this.problem = null;
      } catch (error) {
        this.problem = reason(error);
      }
    }
    if (this.isConnected) this.#timer = window.setTimeout(() => void this.#ask(), ASK_MS);
  }

  override render() {
    const kind = this.kinds.find(({ name }) => name === this.kind);
    const { name } = this.device;
    return html`
      <section class="panel stack" aria-label="Power and faults">
        <div class="row"><h2 class="grow">Power</h2>
          <button class="small" ?disabled=${!this.usable} title="Off and on again"
            @click=${() => attempt(() => this.api.powerCycle(name), "Switched off and on")}>Power cycle</button>
          <button class="small danger" ?disabled=${!this.usable} title="What flash had not finished is lost" @click=${this.#cut}>Power cut</button>
        </div>
        <h2>Faults on purpose</h2>
        ${this.problem ? html`<p class="error-text">${this.problem}</p>` : nothing}
        ${this.#list()}
        ${kind ? this.#form(kind) : nothing}
      </section>
    `;
  }

  async #cut(): Promise<void> {
    const agreed = await confirm({
      heading: "Cut the power?",
      text: "The controller starts again at once; what its flash was writing is lost or torn.",
      yes: "Cut",
      danger: true,
    });
    if (agreed) await attempt(() => this.api.powerCut(this.device.name), "Power cut");
  }

  #list() {
    if (this.faults.length === 0) return html`<p class="muted">There is none.</p>`;
    return html`
      <table aria-label="Faults">
        <thead><tr><th>Fault</th><th>With</th><th>State</th>
          <th><button class="small plain" ?disabled=${!this.usable}
            @click=${() => this.#do(() => this.api.clearFaults(this.device.name))}>Clear all</button></th></tr></thead>
        <tbody>
          ${this.faults.map((fault) => {
            const { id, kind, state, ...rest } = fault;
            const details = Object.entries(rest).map(([key, value]) => `${key} ${typeof value === "object" ? JSON.stringify(value) : String(value)}`);
            return html`
              <tr><td>${words(String(kind))}</td><td>${details.join(", ")}</td>
                <td><span class="badge ${state === "active" ? "error" : "warn"}">${state}</span></td>
                <td><button class="small" ?disabled=${!this.usable} aria-label="Clear ${words(String(kind))}"
                  @click=${() => this.#do(() => this.api.clearFault(this.device.name, id))}>Clear</button></td></tr>`;
          })}
        </tbody>
      </table>
    `;
  }

  async #do(work: () => Promise<unknown>): Promise<void> {
    await attempt(work);
    await this.#ask();
  }

  #form(kind: FaultKind) {
    const keys = ["at", ...(kind.lasts ? ["duration"] : [])];
    return html`
      <form class="stack" @submit=${this.#add}>
        <label>Kind
          <select @change=${(event: Event) => (this.kind = (event.target as HTMLSelectElement).value)}>
            ${this.kinds.map(({ name }) => html`<option value=${name} ?selected=${name === this.kind}>${words(name)}</option>`)}
          </select>
        </label>
        <p class="about">${kind.text.split("`").map((part, n) => (n % 2 === 0 ? part : html`<code>${part}</code>`))}</p>
        <div class="fields">
          ${kind.needs.map((key) => this.#field(key, true))} ${kind.may.map((key) => this.#field(key, false))}
          ${keys.map((key) => this.#field(key, false))}
        </div>
        <div class="row"><span class="grow"></span><button ?disabled=${!this.usable}>Add</button></div>
      </form>
    `;
  }

  #field(key: string, needed: boolean) {
    const label = `${key === "at" ? "begins in" : words(key)}${UNITS[key] ? ` (${UNITS[key]})` : ""}`;
    const choices = this.#choices(key);
    if (choices) {
      return html`<label>${label}<select name=${key}>
        ${needed ? nothing : html`<option value="">any</option>`}
        ${choices.map((choice) => html`<option>${choice}</option>`)}</select></label>`;
    }
    return html`<label>${label}<input name=${key} type="text" class="number" autocomplete="off" ?required=${needed} /></label>`;
  }

  #choices(key: string): string[] | null {
    switch (key) {
      case "axis":
        return this.catalog.axes;
      case "pin":
        return this.catalog.pins.filter(({ kind }) => kind !== "output" && kind !== "analog_output").map(({ name }) => name);
      case "port":
        return ["usb", "rs485", "can"];
      case "way":
        return ["in", "out"];
      case "value":
        return ["true", "false"];
      default:
        return null;
    }
  }

  #add(event: SubmitEvent): void {
    event.preventDefault();
    const fault: Record<string, unknown> = { kind: this.kind };
    for (const [key, entry] of new FormData(event.target as HTMLFormElement)) {
      const text = String(entry).trim();
      if (text === "") continue;
      const value = WORDS.includes(key) ? text : key === "value" ? text === "true" : parseNumber(text);
      if (value === null) {
        say(`${words(key)}: “${text}” is not a number.`, "error");
        return;
      }
      fault[key] = value;
    }
    void this.#do(() => this.api.addFault(this.device.name, fault));
  }
}
customElements.define("pt-faults", Faults);

function words(name: string): string {
  return name.replaceAll("_", " ");
}
