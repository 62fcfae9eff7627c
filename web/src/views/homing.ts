// Homing by each mode that the model has.

import { css, html, nothing } from "lit";
import { base } from "../ui/styles.ts";
import { attempt } from "../ui/toast.ts";
import { axisPicker } from "../ui/axis-picker.ts";
import { Tab } from "./tab.ts";

class Homing extends Tab {
  static override properties = { ...Tab.properties, axis: { state: true }, mode: { state: true } };
  declare axis: string;
  declare mode: number;

  static override styles = [
    base,
    css`
      .panel {
        height: 100%;
      }
      .about {
        min-height: 2.8em;
        font-size: 13px;
        color: var(--muted);
      }
    `,
  ];

  override willUpdate(changed: Map<string, unknown>): void {
    super.willUpdate(changed);
    if (changed.has("catalog")) {
      this.axis = this.catalog.axes[0] ?? "";
      this.mode = this.catalog.homing[0]?.id ?? 0;
    }
  }

  override render() {
    const { homing, axes } = this.catalog;
    const mode = homing.find(({ id }) => id === this.mode);
    return html`
      <section class="panel stack" aria-label="Home">
        <div class="row"><h2 class="grow">Home</h2>
          ${axisPicker(axes, this.axis, "home-axis", (axis) => (this.axis = axis))}
        </div>
        <label>Mode
          <select @change=${(event: Event) => (this.mode = Number((event.target as HTMLSelectElement).value))}>
            ${homing.map(({ id, name }) => html`<option value=${id} ?selected=${id === this.mode}>${id} · ${name}</option>`)}
          </select>
        </label>
        <p class="about">${mode?.text}${mode?.section ? html` <span>(manual, ${mode.section})</span>` : nothing}</p>
        <div class="row">
          ${(["-", "+"] as const).map((sign) =>
            mode?.directions.includes(sign)
              ? html`<button class="grow" ?disabled=${!this.usable}
                  aria-label="Home ${this.axis} in ${sign === "+" ? "positive" : "negative"} direction"
                  @click=${() => this.#home(sign === "+" ? 1 : -1)}>
                  ${sign === "-" ? "◀ Home −" : "Home + ▶"}
                </button>`
              : nothing,
          )}
        </div>
      </section>
    `;
  }

  #home(direction: 1 | -1): void {
    const { axis, mode } = this;
    void attempt(() => this.api.act(this.device.name, { do: "home", axis, mode, direction }));
  }
}
customElements.define("pt-homing", Homing);
