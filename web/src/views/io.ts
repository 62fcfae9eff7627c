// Inputs and outputs, and for virtual controllers the machine behind the pins, hand wheels and faults.

import { css, html, nothing } from "lit";
import { base } from "../ui/styles.ts";
import "./faults.ts";
import { hasHandWheel } from "./hand-wheel.ts";
import { stick } from "./joystick.ts";
import "./machine.ts";
import "./pins.ts";
import { Tab } from "./tab.ts";

class InputsOutputs extends Tab {
  static override styles = [
    base,
    css`
      :host {
        display: grid;
        grid-template-columns: repeat(2, minmax(0, 1fr));
        gap: var(--gap);
        align-items: start;
      }
      .wide {
        grid-column: 1 / -1;
      }
      @media (max-width: 900px) {
        :host {
          grid-template-columns: minmax(0, 1fr);
        }
      }
    `,
  ];

  override render() {
    const isVirtual = this.device.kind === "virtual";
    return html`
      ${isVirtual ? html`<pt-machine class="wide" ${this.given()}></pt-machine>` : nothing}
      <pt-pins class=${isVirtual ? "" : "wide"} ${this.given()}></pt-pins>
      ${isVirtual
        ? html`<div class="stack">
            <pt-faults ${this.given()}></pt-faults>
            ${stick(this.catalog).length > 0 ? html`<pt-joystick ${this.given()}></pt-joystick>` : nothing}
            ${hasHandWheel(this.catalog) ? html`<pt-hand-wheel ${this.given()}></pt-hand-wheel>` : nothing}
          </div>`
        : nothing}
    `;
  }
}
customElements.define("pt-io", InputsOutputs);
