// Status and control: every axis, moves, homing, what can be changed on the way, and the newest minute as a chart.

import { css, html, nothing } from "lit";
import { clock } from "../state/format.ts";
import { base } from "../ui/styles.ts";
import "./axis.ts";
import "./curves.ts";
import "./homing.ts";
import "./moves.ts";
import "./on-the-fly.ts";
import "./ramps.ts";
import { Tab } from "./tab.ts";

class ControlTab extends Tab {
  protected override readonly watches = ["status"] as const;

  static override styles = [
    base,
    css`
      .grid {
        display: grid;
        grid-template-columns: repeat(var(--columns), minmax(0, 1fr));
        gap: var(--gap);
        --columns: 4;
      }
      .grid > * {
        min-width: 0;
      }
      pt-curves {
        grid-column: 1 / -1;
      }
      /* What the last row leaves free is the chart's, if that is two columns. */
      @media (min-width: 1151px) {
        .after-1-of-4 {
          grid-column: 2 / -1;
        }
        .after-2-of-4 {
          grid-column: 3 / -1;
        }
      }
      @media (min-width: 861px) and (max-width: 1150px) {
        .grid {
          --columns: 3;
        }
        .after-1-of-3 {
          grid-column: 2 / -1;
        }
      }
      @media (max-width: 860px) {
        .grid {
          --columns: 2;
        }
      }
      @media (max-width: 600px) {
        .grid {
          --columns: 1;
        }
      }
      .summary {
        min-height: 24px;
        margin-bottom: 8px;
        font-size: 13px;
      }
    `,
  ];

  override render() {
    const { actions, axes, homing } = this.catalog;
    const fly = actions.includes("change_speed") || actions.includes("change_target");
    const parts = axes.length + 2 + (homing.length > 0 ? 1 : 0) + (fly ? 1 : 0);
    return html`
      ${this.#summary()}
      <div class="grid">
        ${axes.map((axis) => html`
          <pt-axis .axis=${axis} ${this.given()}></pt-axis>`)}
        <pt-moves ${this.given()}></pt-moves>
        ${homing.length > 0
          ? html`<pt-homing ${this.given()}></pt-homing>`
          : nothing}
        <pt-ramps ${this.given()}></pt-ramps>
        ${fly
          ? html`<pt-on-the-fly ${this.given()}></pt-on-the-fly>`
          : nothing}
        <pt-curves compact class="after-${parts % 4}-of-4 after-${parts % 3}-of-3" ${this.given()}></pt-curves>
      </div>
    `;
  }

  #summary() {
    const status = this.live.status;
    if (!status) return html`<p class="summary muted">Waiting for the first status…</p>`;
    const running = status.programs.flatMap(({ state }, n) => (state === "idle" ? [] : [`program ${n} ${state}`]));
    // What screen readers hear: words, and only when they change.
    const words = Object.entries(status.axes).map(
      ([axis, one]) => `${axis}: ${one.error ?? (one.speed === 0 ? "standing" : "moving")}`,
    );
    return html`
      <div class="row summary">
        <span class="muted">device time <span class="mono">${clock(status.seconds)}</span></span>
        ${running.map((text) => html`<span class="badge ${text.endsWith("error") ? "error" : "busy"}">${text}</span>`)}
        ${status.alarms.map((alarm) => html`<strong class="error-text">⚠ ${alarm}</strong>`)}
      </div>
      <div class="visually-hidden" aria-live="polite">${words.join(", ")}</div>
    `;
  }
}
customElements.define("pt-control", ControlTab);
