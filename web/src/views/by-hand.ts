// What a hand does to an axis of the machine: its load, turning its shaft, and pulses that its motor does not follow.

import { css, html } from "lit";
import { parseWhole } from "../state/format.ts";
import { base } from "../ui/styles.ts";
import { attempt, say } from "../ui/toast.ts";
import { Tab } from "./tab.ts";

/** Half more than the motor can pull. */
const MAX_LOAD = 1.5;

class ByHand extends Tab {
  static override properties = { ...Tab.properties, axis: { type: String }, load: { type: Number } };
  declare axis: string;
  /** In parts of the motor's pull-out torque. */
  declare load: number;

  static override styles = [
    base,
    css`
      :host {
        display: grid;
        grid-template-columns: minmax(180px, 1fr) auto;
        gap: 6px 18px;
        align-items: center;
      }
      .load {
        display: grid;
        grid-template-columns: auto 1fr 4em;
        gap: 8px;
        align-items: center;
        font-size: 13px;
      }
      output {
        text-align: right;
      }
      form input {
        width: 90px !important;
      }
      @media (max-width: 600px) {
        :host {
          grid-template-columns: 1fr;
        }
      }
    `,
  ];

  override render() {
    return html`
      <div class="load">
        <label for="load">Load</label>
        <input id="load" type="range" min="0" max=${MAX_LOAD} step="0.01" .value=${String(this.load)} ?disabled=${!this.usable}
          aria-label="Load of axis ${this.axis}" title="Part of the motor's pull-out torque; above 1 it stalls"
          @change=${(event: Event) => this.#setLoad(Number((event.target as HTMLInputElement).value))} />
        <output class=${this.load > 1 ? "error-text" : ""}>${Math.round(this.load * 100)} %</output>
      </div>
      <form class="row" @submit=${this.#move}>
        <input name="pulses" class="number" type="text" inputmode="numeric" value="100" aria-label="Pulses, axis ${this.axis}" />
        <button class="small" value="push" ?disabled=${!this.usable} title="Turn the shaft by hand; less than 0 is backwards">Push</button>
        <button class="small" value="lose" ?disabled=${!this.usable} title="The motor does not follow its next pulses">Lose</button>
      </form>
    `;
  }

  #setLoad(load: number): void {
    void attempt(() => this.api.setLoad(this.device.name, this.axis, load));
  }

  #move(event: SubmitEvent): void {
    event.preventDefault();
    const pulses = parseWhole(String(new FormData(event.target as HTMLFormElement).get("pulses")));
    const lose = (event.submitter as HTMLButtonElement | null)?.value === "lose";
    if (pulses === null || (lose && pulses < 1)) {
      say(lose ? "So many pulses cannot be lost." : "Pulses are a whole number.", "error");
      return;
    }
    const { name } = this.device;
    const { axis } = this;
    void attempt(
      () => (lose ? this.api.lose(name, axis, pulses) : this.api.push(name, axis, pulses)),
      lose ? `The next ${pulses} pulses of ${axis} are lost` : `${axis} pushed by ${pulses}`,
    );
  }
}
customElements.define("pt-by-hand", ByHand);
