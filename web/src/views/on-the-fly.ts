// Speed and target of a motor that is moving.

import { css, html, nothing } from "lit";
import { count, parseWhole } from "../state/format.ts";
import { axisPicker } from "../ui/axis-picker.ts";
import { base } from "../ui/styles.ts";
import { attempt, say } from "../ui/toast.ts";
import { Tab } from "./tab.ts";

class OnTheFly extends Tab {
  static override properties = { ...Tab.properties, axis: { state: true } };
  declare axis: string;

  static override styles = [
    base,
    css`
      .panel {
        height: 100%;
      }
      .fields {
        display: flex;
        flex-wrap: wrap;
        gap: 8px;
      }
      .fields label {
        flex: 1;
        min-width: 60px;
      }
      .fields button {
        align-self: flex-end;
        min-width: 96px;
      }
    `,
  ];

  override willUpdate(changed: Map<string, unknown>): void {
    super.willUpdate(changed);
    if (changed.has("catalog")) this.axis = this.catalog.axes[0] ?? "";
  }

  override render() {
    const { actions, axes, parameters, speed_windows, units } = this.catalog;
    const ramp = parameters.find(({ role }) => role === "acceleration");
    const window = parameters.find(({ role, axis }) => role === "speed_window" && axis === this.axis)?.id;
    return html`
      <div class="panel stack">
        <div class="row"><h2 class="grow">On the fly</h2>
          ${axisPicker(axes, this.axis, "fly-axis", (axis) => (this.axis = axis))}
        </div>
        ${window !== undefined
          ? html`<form class="fields" @submit=${(event: SubmitEvent) => this.#setWindow(event, window)}>
              <label title="Both speeds have to lie in it; it can be set while the motor stands">Speed window (pps)
                <select name="window">
                  <option value="0">0 · no changes</option>
                  ${speed_windows.map(({ number, from_pps, to_pps }) => html`
                    <option value=${number}>${number} · ${count(from_pps)} to ${count(to_pps)}</option>`)}
                </select>
              </label>
              <button ?disabled=${!this.usable}>Set ${window}</button>
            </form>`
          : nothing}
        ${actions.includes("change_speed")
          ? html`<form class="fields" @submit=${this.#speed}>
              <label>Speed (${units.speed})<input name="speed" class="number" type="text" inputmode="numeric" value="1000" /></label>
              <label title=${ramp ? `${ramp.name}; empty: as it is` : "empty: as it is"}>Accel${ramp?.unit ? ` (${ramp.unit})` : ""}<input name="acceleration" class="number" type="text" inputmode="numeric" /></label>
              <button ?disabled=${!this.usable}>Set speed</button>
            </form>`
          : nothing}
        ${actions.includes("change_target")
          ? html`<form class="fields" @submit=${this.#target}>
              <label>Target (${units.position})<input name="target" class="number" type="text" inputmode="numeric" value="1000" /></label>
              <button ?disabled=${!this.usable}>Set target</button>
            </form>`
          : nothing}
      </div>
    `;
  }

  #setWindow(event: SubmitEvent, id: string): void {
    event.preventDefault();
    const number = Number(new FormData(event.target as HTMLFormElement).get("window"));
    void attempt(() => this.api.setParameter(this.device.name, id, number), `${id} is ${number}`);
  }

  #speed(event: SubmitEvent): void {
    event.preventDefault();
    const data = new FormData(event.target as HTMLFormElement);
    const values: Record<string, number> = {};
    for (const name of ["speed", "acceleration"]) {
      const text = String(data.get(name) ?? "").trim();
      if (text === "" && name !== "speed") continue;
      const value = parseWhole(text);
      if (value === null) {
        say(`“${text}” is not a whole number.`, "error");
        return;
      }
      values[name] = value;
    }
    const { axis } = this;
    void attempt(() => this.api.act(this.device.name, { do: "change_speed", axis, speed: values["speed"]!, ...values }));
  }

  #target(event: SubmitEvent): void {
    event.preventDefault();
    const target = parseWhole(String(new FormData(event.target as HTMLFormElement).get("target")));
    if (target === null) say("A target is a whole number.", "error");
    else void attempt(() => this.api.act(this.device.name, { do: "change_target", axis: this.axis, target }));
  }
}
customElements.define("pt-on-the-fly", OnTheFly);
