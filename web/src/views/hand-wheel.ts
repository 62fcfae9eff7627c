// A hand wheel: the manual pulse generator of models that take one, in steps.

import { css, html } from "lit";
import type { Catalog } from "../api/contract.ts";
import { axisPicker } from "../ui/axis-picker.ts";
import { base } from "../ui/styles.ts";
import { attempt } from "../ui/toast.ts";
import { Tab } from "./tab.ts";

const STEPS = [-100, -10, -1, 1, 10, 100];

/** Models that cannot switch an axis to a pulse generator have no input for one. */
export function hasHandWheel(catalog: Catalog): boolean {
  return catalog.parameters.some(({ role }) => role === "pulser_enable");
}

class HandWheel extends Tab {
  static override properties = { ...Tab.properties, axis: { state: true } };
  declare axis: string;

  static override styles = [
    base,
    css`
      .steps {
        display: grid;
        grid-template-columns: repeat(${STEPS.length}, 1fr);
        gap: 6px;
      }
      button {
        padding: 3px 4px;
      }
      p {
        font-size: 13px;
      }
    `,
  ];

  override willUpdate(changed: Map<string, unknown>): void {
    super.willUpdate(changed);
    if (changed.has("catalog")) this.axis = this.catalog.axes[0] ?? "";
  }

  override render() {
    return html`
      <section class="panel stack" aria-label="Hand wheel">
        <div class="row"><h2 class="grow">Hand wheel</h2>
          ${axisPicker(this.catalog.axes, this.axis, "wheel-axis", (axis) => (this.axis = axis))}
        </div>
        <p class="muted">Counts of the manual pulse generator; the axis follows where ${this.#enable} is 1.</p>
        <div class="steps">
          ${STEPS.map((counts) => html`<button ?disabled=${!this.usable} @click=${() => this.#turn(counts)}>
            ${counts > 0 ? `+${counts}` : `−${-counts}`}</button>`)}
        </div>
      </section>
    `;
  }

  get #enable(): string {
    const info = this.catalog.parameters.find(({ role, axis }) => role === "pulser_enable" && axis === this.axis);
    return info?.id ?? "";
  }

  #turn(counts: number): void {
    void attempt(() => this.api.turnPulser(this.device.name, this.axis, counts));
  }
}
customElements.define("pt-hand-wheel", HandWheel);
