// Motion profile preview: how long a move will take, how fast it gets, and its curves, before it is made.

import { css, html, nothing, svg } from "lit";
import type { ParameterInfo } from "../api/contract.ts";
import { count, decimal, parseNumber } from "../state/format.ts";
import { base } from "../ui/styles.ts";
import { attempt, say } from "../ui/toast.ts";
import { points, type Profile, profile } from "./profile.ts";
import { deciding, plan } from "./settings.ts";
import { Tool, toolStyles } from "./tool.ts";

const WIDTH = 900;
const HEIGHT = 260;
/** Room for the letters at the edges. */
const [LEFT, RIGHT, TOP, BOTTOM] = [70, 76, 12, 30];
const POINTS = 241;
const MARKS = 4;

class Preview extends Tool {
  static override properties = { ...Tool.properties, distance: { state: true } };
  /** In the controller's units, to where from here. */
  declare distance: number;

  static override styles = [
    base,
    toolStyles,
    css`
      svg {
        display: block;
        width: 100%;
        height: auto;
        font-size: 12px;
      }
      .grid {
        stroke: var(--line);
      }
      .frame {
        fill: none;
        stroke: var(--strong-line);
      }
      text {
        fill: var(--muted);
      }
      .speed {
        fill: none;
        stroke: var(--curve-1);
        stroke-width: 2.2;
      }
      .position {
        fill: none;
        stroke: var(--curve-2);
        stroke-width: 2.2;
        stroke-dasharray: 7 4;
      }
      text.of-speed {
        fill: var(--curve-1);
      }
      text.of-position {
        fill: var(--curve-2);
      }
    `,
  ];

  constructor() {
    super();
    this.distance = 0;
  }

  protected override needs(): ParameterInfo[] {
    return deciding(this.catalog, this.axis);
  }

  override firstUpdated(): void {
    this.distance = this.catalog.language === "tmcl" ? 51_200 : 10_000;
  }

  async #move(): Promise<void> {
    await attempt(
      () => this.api.act(this.device.name, { do: "move", targets: { [this.axis]: this.distance }, relative: true }),
      "Move begun",
    );
  }

  override render() {
    const known = Object.keys(this.values).length > 0;
    const { move, notes } = plan(this.catalog, this.axis, this.values, this.distance);
    const made = profile(move);
    const { tried } = this;
    return html`
      <section class="panel stack" aria-label="Move">
        <div class="row">
          <h2 class="grow">Move</h2>
          ${this.picker()}
          <button class="small" ?disabled=${!this.reachable} @click=${() => this.refresh()}>Read settings</button>
        </div>
        <div class="row end">
          <label>
            Distance [${this.catalog.units.position}]
            <input
              inputmode="numeric"
              autocomplete="off"
              .value=${String(this.distance)}
              @input=${(event: Event) => {
                const way = parseNumber((event.target as HTMLInputElement).value);
                if (way !== null && Number.isInteger(way)) this.distance = way;
              }}
            />
          </label>
          <button class="primary" ?disabled=${!this.usable || tried.length > 0 || this.distance === 0} @click=${() => this.#move()}>
            Make this move
          </button>
          ${tried.length > 0
            ? html`
                <button ?disabled=${!this.usable} @click=${() => this.#write()}>Write ${tried.length} tried</button>
                <button @click=${() => (this.values = { ...this.read })}>Undo</button>
              `
            : nothing}
        </div>
        <details>
          <summary>Settings of the ramp</summary>
          <div class="fields">${this.needs().map((info) => this.trial(info))}</div>
        </details>
      </section>
      ${known && made.seconds > 0 ? this.#result(made, notes) : html`<p class="muted">Nothing moves.</p>`}
    `;
  }

  async #write(): Promise<void> {
    const { length } = this.tried;
    await this.writeTried();
    if (this.tried.length === 0) say(`${length} settings written`);
  }

  #result(made: Profile, notes: string[]) {
    const fact = (name: string, value: string, unit: string) => html`
      <div>
        <dt>${name}</dt>
        <dd>${value} ${unit}</dd>
      </div>
    `;
    return html`
      <section class="panel stack" aria-label="Profile">
        <dl>
          ${fact("Time", decimal(made.seconds, 3), "s")}
          ${fact(made.reached ? "Highest speed" : "Highest speed (not the one set)", count(Math.round(made.peakPps)), "pps")}
          ${fact("Accelerates for", decimal(made.up.seconds, 3), "s")} ${fact("Constant for", decimal(made.cruiseSeconds, 3), "s")}
          ${fact("Decelerates for", decimal(made.down.seconds, 3), "s")} ${fact("Distance", count(Math.round(made.pulses)), "pulses")}
        </dl>
        ${this.#plot(made)} ${notes.map((note) => html`<p class="warn-text">${note}</p>`)}
      </section>
    `;
  }

  #plot(made: Profile) {
    const list = points(made, POINTS);
    const x = (seconds: number) => LEFT + (seconds / made.seconds) * (WIDTH - LEFT - RIGHT);
    const y = (share: number) => HEIGHT - BOTTOM - share * (HEIGHT - TOP - BOTTOM);
    const line = (value: (point: (typeof list)[number]) => number) =>
      list.map((point) => `${x(point.seconds).toFixed(1)},${y(value(point)).toFixed(1)}`).join(" ");
    const sign = this.distance < 0 ? -1 : 1;
    const marks = Array.from({ length: MARKS + 1 }, (_, n) => n / MARKS);
    const words = `Speed rises to ${Math.round(made.peakPps)} pulses a second and falls again within ${made.seconds.toFixed(3)} seconds.`;
    return html`
      <svg viewBox="0 0 ${WIDTH} ${HEIGHT}" role="img" aria-label=${words}>
        ${marks.map(
          (share) => svg`
            <line class="grid" x1=${LEFT} x2=${WIDTH - RIGHT} y1=${y(share)} y2=${y(share)} />
            <line class="grid" y1=${TOP} y2=${HEIGHT - BOTTOM} x1=${x(share * made.seconds)} x2=${x(share * made.seconds)} />
            <text class="of-speed" x=${LEFT - 6} y=${y(share) + 4} text-anchor="end">${count(Math.round(share * made.peakPps))}</text>
            <text class="of-position" x=${WIDTH - RIGHT + 6} y=${y(share) + 4}>${count(Math.round(sign * share * made.pulses))}</text>
            <text x=${x(share * made.seconds)} y=${HEIGHT - 8} text-anchor="middle">${decimal(share * made.seconds, 3)} s</text>
          `,
        )}
        <rect class="frame" x=${LEFT} y=${TOP} width=${WIDTH - LEFT - RIGHT} height=${HEIGHT - TOP - BOTTOM} />
        <polyline class="position" points=${line(({ pulses }) => pulses / made.pulses)} />
        <polyline class="speed" points=${line(({ pps }) => pps / made.peakPps)} />
      </svg>
      <p class="muted">Full: speed in pulses a second. Dashed: way in pulses.</p>
    `;
  }
}
customElements.define("pt-preview", Preview);
