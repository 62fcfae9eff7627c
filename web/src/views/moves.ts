// Moves to targets, of one axis or of several at once, and back to 0; stop and abort of all axes.

import { css, html, nothing } from "lit";
import { parseWhole } from "../state/format.ts";
import { base } from "../ui/styles.ts";
import { attempt, say } from "../ui/toast.ts";
import { Tab } from "./tab.ts";

class Moves extends Tab {
  static override properties = { ...Tab.properties, chosen: { state: true }, relative: { state: true } };
  /** The axes that a move is for. */
  declare chosen: ReadonlySet<string>;
  /** Where the controller itself has no move mode. */
  declare relative: boolean;
  protected override readonly watches = ["status"] as const;

  static override styles = [
    base,
    css`
      .panel {
        height: 100%;
      }
      .targets {
        display: grid;
        grid-template-columns: auto minmax(0, 1fr) auto;
        gap: 6px 10px;
        align-items: center;
      }
      .mode {
        display: inline-flex;
      }
      .mode button:first-child {
        border-radius: var(--radius) 0 0 var(--radius);
      }
      .mode button:last-child {
        margin-left: -1px;
        border-radius: 0 var(--radius) var(--radius) 0;
      }
      .head {
        justify-content: space-between;
      }
    `,
  ];

  constructor() {
    super();
    this.chosen = new Set();
    this.relative = false;
  }

  override willUpdate(changed: Map<string, unknown>): void {
    super.willUpdate(changed);
    if (changed.has("catalog")) this.chosen = new Set(this.catalog.axes.slice(0, 1));
  }

  /** The controller's own mode where it has one. */
  get #isRelative(): boolean {
    const absolute = this.live.status?.absolute;
    return typeof absolute === "boolean" ? !absolute : this.relative;
  }

  override render() {
    const { axes } = this.catalog;
    const relative = this.#isRelative;
    const several = this.chosen.size > 1;
    return html`
      <form class="panel stack" @submit=${this.#go}>
        <div class="row head">
          <h2>Move</h2>
          <div class="mode" role="group" aria-label="Move mode">
            <button type="button" class="small" aria-pressed=${!relative} ?disabled=${!this.usable}
              title="Targets are positions" @click=${() => this.#setRelative(false)}>ABS</button>
            <button type="button" class="small" aria-pressed=${relative} ?disabled=${!this.usable}
              title="Targets are distances" @click=${() => this.#setRelative(true)}>INC</button>
          </div>
        </div>
        <div class="targets">
          ${axes.map(
            (axis) => html`
              <label class="line">
                ${axes.length > 1
                  ? html`<input type="checkbox" aria-label="Move axis ${axis}" .checked=${this.chosen.has(axis)}
                      @change=${(event: Event) => this.#choose(axis, (event.target as HTMLInputElement).checked)} />`
                  : nothing}
                <strong>${axis}</strong>
              </label>
              <input name=${axis} class="number" type="text" inputmode="numeric" value="0" autocomplete="off"
                aria-label="${relative ? "Distance" : "Target"} of axis ${axis} in ${this.catalog.units.position}" />
              <span class="muted">${this.catalog.units.position}</span>
            `,
          )}
        </div>
        <div class="row">
          <button class="primary grow" ?disabled=${!this.usable || this.chosen.size === 0}>
            ${several ? `Move ${[...this.chosen].join(", ")} together` : relative ? "Move by" : "Move to"}
          </button>
          <button type="button" ?disabled=${!this.usable || this.chosen.size === 0} title="Move to position 0"
            @click=${this.#zero}>Return to 0</button>
        </div>
        <div class="row">
          <button type="button" class="grow" ?disabled=${!this.reachable} title="With deceleration"
            @click=${() => attempt(() => this.api.stop(this.device.name))}>Stop all axes</button>
          ${this.catalog.actions.includes("abort")
            ? html`<button type="button" class="danger grow" ?disabled=${!this.usable} title="At once, without deceleration"
                @click=${() => attempt(() => this.api.act(this.device.name, { do: "abort" }))}>Abort</button>`
            : nothing}
        </div>
      </form>
    `;
  }

  #choose(axis: string, on: boolean): void {
    this.chosen = new Set(this.catalog.axes.filter((one) => (one === axis ? on : this.chosen.has(one))));
  }

  #setRelative(relative: boolean): void {
    this.relative = relative;
    if (this.catalog.actions.includes("set_mode")) {
      void attempt(() => this.api.act(this.device.name, { do: "set_mode", absolute: !relative }));
    }
  }

  #go(event: SubmitEvent): void {
    event.preventDefault();
    const data = new FormData(event.target as HTMLFormElement);
    const targets: Record<string, number> = {};
    for (const axis of this.chosen) {
      const target = parseWhole(String(data.get(axis)));
      if (target === null) {
        say(`The target of axis ${axis} is not a whole number.`, "error");
        return;
      }
      targets[axis] = target;
    }
    this.#move(targets, this.#isRelative);
  }

  #zero(): void {
    this.#move(Object.fromEntries([...this.chosen].map((axis) => [axis, 0])), false);
  }

  #move(targets: Record<string, number>, relative: boolean): void {
    void attempt(() => this.api.act(this.device.name, { do: "move", targets, relative }));
  }
}
customElements.define("pt-moves", Moves);
