// One axis: what it shows, jogging while a button is held, stop, motor power, clearing its error, its counters.

import { css, html, nothing } from "lit";
import type { AxisStatus } from "../api/contract.ts";
import { count, parseWhole } from "../state/format.ts";
import { Jog } from "../state/jog.ts";
import { lamp, lampStyles } from "../ui/lamp.ts";
import { stateKind } from "../ui/state.ts";
import { base } from "../ui/styles.ts";
import { attempt, say } from "../ui/toast.ts";
import "../ui/hold.ts";
import { Tab } from "./tab.ts";

class Axis extends Tab {
  static override properties = { ...Tab.properties, axis: { type: String } };
  declare axis: string;
  protected override readonly watches = ["status"] as const;

  #jog: Jog | null = null;

  static override styles = [
    base,
    lampStyles,
    css`
      .panel {
        display: flex;
        flex-direction: column;
        gap: 8px;
        height: 100%;
      }
      .panel.error {
        border-color: var(--error);
      }
      .name {
        font-size: 16px;
        font-weight: 700;
      }
      .position {
        font-size: 30px;
        font-weight: 600;
        line-height: 1.1;
        text-align: right;
        font-variant-numeric: tabular-nums;
      }
      .unit {
        color: var(--muted);
        font-size: 12px;
        font-weight: 400;
      }
      dl {
        display: grid;
        grid-template-columns: repeat(2, auto 1fr);
        gap: 2px 8px;
        margin: 0;
      }
      dt {
        color: var(--muted);
        font-size: 12px;
        line-height: 20px;
      }
      dd {
        margin: 0;
        text-align: right;
        font-variant-numeric: tabular-nums;
      }
      .lamps {
        display: flex;
        flex-wrap: wrap;
        gap: 4px 14px;
      }
      .error-line {
        display: flex;
        align-items: center;
        gap: 8px;
        min-height: 26px;
        font-size: 13px;
      }
      .jog {
        display: grid;
        grid-template-columns: 1fr auto 1fr;
        gap: 8px;
      }
      .jog button {
        min-height: 38px;
      }
      details {
        font-size: 13px;
      }
      summary {
        color: var(--muted);
        font-size: 12px;
        cursor: pointer;
      }
      ul {
        display: grid;
        grid-template-columns: repeat(auto-fill, minmax(140px, 1fr));
        gap: 1px 10px;
        margin: 6px 0 0;
        padding: 0;
        list-style: none;
      }
      .set {
        display: grid;
        grid-template-columns: 1fr auto;
        gap: 6px;
        margin-top: 6px;
        align-items: end;
      }
    `,
  ];

  override render() {
    const status = this.live.status?.axes[this.axis];
    if (!status) return html`<section class="panel"><span class="name">${this.axis}</span> –</section>`;
    const can = (what: string) => this.catalog.actions.includes(what);
    const axis = this.axis;
    return html`
      <section class="panel ${status.error ? "error" : ""}" aria-label="Axis ${axis}">
        <div class="row">
          <span class="name">${/^\d+$/.test(axis) ? `Axis ${axis}` : axis}</span>
          <span class="badge ${stateKind(status)}" data-role="state">${status.state}</span>
          ${status.loop_state && status.loop_state !== "NA"
            ? html`<span class="badge" title="StepNLoop">${status.loop_state}</span>`
            : nothing}
          <span class="grow"></span>
          ${can("power") && status.enabled !== null
            ? html`<button class="small" aria-pressed=${status.enabled} ?disabled=${!this.usable}
                @click=${() => this.#act({ do: "power", axis, on: !status.enabled })}>
                motor ${status.enabled ? "on" : "off"}
              </button>`
            : nothing}
        </div>
        <div class="position" data-role="position">
          ${count(status.position)} <span class="unit">${this.catalog.units.position}</span>
        </div>
        ${this.#values(status)}
        <div class="lamps">
          ${lamp("−L", status.negative_limit, "negative limit", true)}
          ${lamp("Home", status.home, "home switch")}
          ${lamp("+L", status.positive_limit, "positive limit", true)}
          ${lamp("Z", status.index, "encoder index")}
        </div>
        <div class="error-line">
          ${status.error
            ? html`<span class="grow"><strong class="error-text">⚠ ${status.error}</strong>
                ${this.catalog.language === "a-script" ? html`<span class="muted">Moves are refused until it is cleared.</span>` : nothing}</span>`
            : html`<span class="muted grow">no error</span>`}
          ${can("clear_error")
            ? html`<button class="small" ?disabled=${!this.usable || !status.error}
                @click=${() => this.#act({ do: "clear_error", axis })}>Clear</button>`
            : nothing}
        </div>
        <div class="jog">
          <pt-hold .disabled=${!this.usable} .label=${`Jog ${axis} in negative direction while pressed`}
            @begin=${() => this.#jogTo(-1)} @end=${() => this.#jog?.end()}>◀ −</pt-hold>
          <button ?disabled=${!this.reachable} aria-label="Stop ${axis}" title="Stop with deceleration"
            @click=${this.#stop}>■</button>
          <pt-hold .disabled=${!this.usable} .label=${`Jog ${axis} in positive direction while pressed`}
            @begin=${() => this.#jogTo(1)} @end=${() => this.#jog?.end()}>+ ▶</pt-hold>
        </div>
        ${this.#bits(status)} ${this.#counters(can)}
      </section>
    `;
  }

  #values(status: AxisStatus) {
    const { units } = this.catalog;
    const rows: [string, number | null, string][] = [
      ["Speed", status.speed, units.speed],
      ["Target", status.target, units.position],
      ["Encoder", status.encoder, units.encoder],
      ["Delta", status.delta, units.encoder],
      ["Load", status.load, ""],
    ];
    // A value that the model never has takes no room; one that it has not now keeps its place.
    const shown = rows.filter(([label, value]) => value !== null || label === "Target" || label === "Encoder");
    return html`
      <dl>
        ${shown.map(([label, value, unit]) => html`<dt>${label}</dt><dd data-role=${label.toLowerCase()}>${count(value)}
          ${value === null || unit === "" ? nothing : html`<span class="unit">${unit}</span>`}</dd>`)}
      </dl>
    `;
  }

  #bits(status: AxisStatus) {
    if (this.catalog.status_bits.length === 0) return nothing;
    return html`
      <details>
        <summary>Status bits · ${status.flags.join(", ") || "none set"}</summary>
        <ul>
          ${this.catalog.status_bits.map(
            ({ name, text, kind }) => html`<li>${lamp(name, status.flags.includes(name), text || name, kind === "error")}</li>`,
          )}
        </ul>
      </details>
    `;
  }

  #counters(can: (what: string) => boolean) {
    const rows = [
      { action: "set_position", label: "Position counter", reset: "RP" },
      { action: "set_encoder", label: "Encoder counter", reset: "RE" },
    ] as const;
    const shown = rows.filter(({ action }) => can(action));
    if (shown.length === 0) return nothing;
    return html`
      <details>
        <summary>Set counters</summary>
        ${shown.map(
          ({ action, label }) => html`
            <form class="set" @submit=${(event: SubmitEvent) => this.#set(event, action)}>
              <label>${label}<input name="value" class="number" type="text" inputmode="numeric" value="0" autocomplete="off" /></label>
              <button ?disabled=${!this.usable}>Set</button>
            </form>
          `,
        )}
      </details>
    `;
  }

  #set(event: SubmitEvent, action: "set_position" | "set_encoder"): void {
    event.preventDefault();
    const value = parseWhole(String(new FormData(event.target as HTMLFormElement).get("value")));
    if (value === null) say("A counter takes a whole number.", "error");
    else void this.#act({ do: action, axis: this.axis, value });
  }

  #act(action: Parameters<typeof this.api.act>[1]): Promise<boolean> {
    return attempt(() => this.api.act(this.device.name, action));
  }

  #jogTo(direction: 1 | -1): void {
    this.#jog ??= new Jog(this.api, this.live, this.axis);
    this.#jog.begin(direction);
  }

  /** Whoever has no control can stop the whole controller. */
  #stop(): void {
    if (this.locked) void attempt(() => this.api.stop(this.device.name));
    else void this.#act({ do: "stop", axis: this.axis });
  }
}
customElements.define("pt-axis", Axis);
