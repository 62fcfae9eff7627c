// The speeds and ramps that the next moves have: the parameters of the catalog that say so, for all axes or for one.

import { css, html, nothing } from "lit";
import { type ApiError, reason } from "../api/client.ts";
import type { ParameterInfo, Role, Value } from "../api/contract.ts";
import { decimal, parseNumber } from "../state/format.ts";
import { base } from "../ui/styles.ts";
import { attempt, say } from "../ui/toast.ts";
import { Tab } from "./tab.ts";

const RAMPS: (Role | null)[] = ["high_speed", "low_speed", "acceleration", "deceleration"];

/** The parameters of the panel. */
export function ramps(parameters: ParameterInfo[]): ParameterInfo[] {
  return parameters.filter(({ role, readable, writable }) => readable && writable && RAMPS.includes(role));
}

class Ramps extends Tab {
  static override properties = { ...Tab.properties, values: { state: true }, axis: { state: true } };
  declare values: Record<string, Value>;
  /** Whose; `null` is what holds for all axes. */
  declare axis: string | null;
  #read = false;

  static override styles = [
    base,
    css`
      .panel {
        height: 100%;
      }
      .fields {
        display: grid;
        grid-template-columns: repeat(auto-fit, minmax(96px, 1fr));
        gap: 8px;
      }
      select {
        width: auto;
      }
    `,
  ];

  constructor() {
    super();
    this.values = {};
    this.axis = null;
  }

  override willUpdate(changed: Map<string, unknown>): void {
    super.willUpdate(changed);
    if (changed.has("catalog")) this.axis = this.#owners()[0] ?? null;
  }

  override updated(changed: Map<string, unknown>): void {
    // Elsewhere they may have been changed meanwhile.
    if (changed.has("active") && this.active) this.#read = false;
    if (!this.#read && this.reachable && this.active) {
      this.#read = true;
      void this.#readAll();
    }
  }

  #owners(): (string | null)[] {
    return [...new Set(ramps(this.catalog.parameters).map(({ axis }) => axis))];
  }

  async #readAll(): Promise<void> {
    for (const { id } of ramps(this.catalog.parameters)) {
      try {
        const value = await this.api.parameter(this.device.name, id);
        this.values = { ...this.values, [id]: value };
      } catch (error) {
        if ((error as ApiError).status !== 0) say(`${id}: ${reason(error)}`, "error");
        this.#read = (error as ApiError).status !== 0;
        return;
      }
    }
  }

  override render() {
    const owners = this.#owners();
    if (owners.length === 0) return nothing;
    const shown = ramps(this.catalog.parameters).filter(({ axis }) => axis === this.axis);
    return html`
      <form class="panel stack" @submit=${this.#set}>
        <div class="row"><h2 class="grow">Speeds and ramps</h2>
          ${owners.length > 1
            ? html`<select aria-label="Whose" @change=${this.#pick}>
                ${owners.map((owner) => html`<option value=${owner ?? ""} ?selected=${owner === this.axis}>
                  ${owner === null ? "all axes" : `axis ${owner}`}</option>`)}
              </select>`
            : nothing}
        </div>
        <div class="fields">
          ${shown.map((info) => html`
            <label title="${info.text} (${info.symbol}, manual ${info.section})">
              ${info.name}${info.unit ? ` (${info.unit})` : ""}
              <input name=${info.id} class="number" type="text" inputmode="decimal" autocomplete="off"
                .value=${this.#show(info)} />
            </label>`)}
        </div>
        <div class="row"><span class="grow"></span>
          <button type="button" ?disabled=${!this.reachable} @click=${() => this.#readAll()}>Read</button>
          <button ?disabled=${!this.usable}>Set</button>
        </div>
      </form>
    `;
  }

  #show(info: ParameterInfo): string {
    const value = this.values[info.id];
    if (value === undefined) return "";
    return typeof value === "number" ? decimal(value, info.decimals).replace("\u2212", "-") : value;
  }

  #pick(event: Event): void {
    this.axis = (event.target as HTMLSelectElement).value || null;
  }

  /** Writes what was changed. */
  async #set(event: SubmitEvent): Promise<void> {
    event.preventDefault();
    const data = new FormData(event.target as HTMLFormElement);
    for (const info of ramps(this.catalog.parameters).filter(({ axis }) => axis === this.axis)) {
      const text = String(data.get(info.id)).trim();
      if (text === "" || text === this.#show(info)) continue;
      const value = parseNumber(text);
      if (value === null) {
        say(`${info.name}: “${text}” is not a number.`, "error");
        return;
      }
      if (!(await attempt(() => this.api.setParameter(this.device.name, info.id, value)))) return;
      this.values = { ...this.values, [info.id]: value };
    }
  }
}
customElements.define("pt-ramps", Ramps);
