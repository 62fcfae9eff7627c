// What the tools share: an axis, the parameters that they need, and writing one.

import { css, html, nothing, type PropertyValues } from "lit";
import type { ParameterInfo, Value } from "../api/contract.ts";
import { range } from "../parameters/value.ts";
import { parseNumber } from "../state/format.ts";
import { axisPicker } from "../ui/axis-picker.ts";
import { attempt } from "../ui/toast.ts";
import { Tab } from "../views/tab.ts";

export const toolStyles = css`
  :host {
    max-width: 1180px;
  }
  .panel {
    margin-bottom: var(--gap);
  }
  .fields {
    display: grid;
    grid-template-columns: repeat(auto-fill, minmax(148px, 1fr));
    gap: 8px 12px;
  }
  .row > select,
  .row > label select {
    width: auto;
    max-width: 100%;
  }
  .text {
    max-width: 76ch;
    color: var(--muted);
  }
  .large {
    font-size: 20px;
    font-weight: 650;
    font-variant-numeric: tabular-nums;
  }
  dl {
    display: grid;
    grid-template-columns: repeat(auto-fill, minmax(150px, 1fr));
    gap: 8px 14px;
    margin: 0;
  }
  dt {
    color: var(--muted);
    font-size: 12px;
  }
  dd {
    margin: 0;
    font-weight: 600;
    font-variant-numeric: tabular-nums;
  }
`;

/** A tool derives from this and says in `needs` which parameters it works with. */
export class Tool extends Tab {
  static override properties = { ...Tab.properties, axis: { state: true }, values: { state: true } };
  declare axis: string;
  /** The parameters as they were read last; what the user tries is changed in here only. */
  declare values: Record<string, Value>;

  /** What the controller has. */
  protected read: Record<string, Value> = {};
  #asked = "";

  constructor() {
    super();
    this.axis = "";
    this.values = {};
  }

  protected needs(): ParameterInfo[] {
    return [];
  }

  override willUpdate(changed: PropertyValues): void {
    super.willUpdate(changed);
    if (this.axis === "") this.axis = this.catalog.axes[0] ?? "";
    if (this.active && this.reachable && this.#asked !== this.axis) {
      this.#asked = this.axis;
      void this.refresh();
    }
    if (!this.active) this.#asked = "";
  }

  /** Reads what the tool needs. */
  async refresh(): Promise<void> {
    const infos = this.needs().filter(({ readable }) => readable);
    await attempt(async () => {
      const pairs = infos.map(async ({ id }) => [id, await this.api.parameter(this.device.name, id)] as const);
      const values: Record<string, Value> = Object.fromEntries(await Promise.all(pairs));
      this.read = values;
      this.values = { ...values };
    });
  }

  /** Writes a parameter; true if the controller took it. */
  protected async write(id: string, value: Value): Promise<boolean> {
    const taken = await attempt(() => this.api.setParameter(this.device.name, id, value));
    if (taken) this.read = { ...this.read, [id]: value };
    this.values = { ...this.values, [id]: taken ? value : (this.read[id] ?? value) };
    return taken;
  }

  /** What the user tries and the controller does not have. */
  protected get tried(): ParameterInfo[] {
    return this.needs().filter(({ id, writable }) => writable && this.values[id] !== this.read[id]);
  }

  protected async writeTried(): Promise<void> {
    for (const { id } of this.tried) {
      const value = this.values[id];
      if (value !== undefined && !(await this.write(id, value))) return;
    }
  }

  protected picker() {
    return axisPicker(this.catalog.axes, this.axis, `${this.localName}-axis`, (axis) => (this.axis = axis));
  }

  /** A field to try a value of a parameter. */
  protected trial(info: ParameterInfo) {
    const value = this.values[info.id];
    const hint = [info.text, range(info)].filter(Boolean).join(" ");
    return html`
      <label title=${hint}>
        ${info.name} ${info.unit ? `[${info.unit}]` : ""}
        <input
          inputmode="decimal"
          autocomplete="off"
          .value=${value === undefined ? "" : String(value)}
          ?readonly=${!info.writable}
          @change=${(event: Event) => this.#try(info, event.target as HTMLInputElement)}
        />
        <span><code>${info.id}</code> ${value !== this.read[info.id] ? html`<span class="badge busy">tried</span>` : nothing}</span>
      </label>
    `;
  }

  #try(info: ParameterInfo, field: HTMLInputElement): void {
    const value = parseNumber(field.value);
    const { low, high } = info;
    const fits = value !== null && (low === null || value >= low) && (high === null || value <= high);
    if (fits) this.values = { ...this.values, [info.id]: value };
    else field.value = String(this.values[info.id] ?? "");
  }
}
