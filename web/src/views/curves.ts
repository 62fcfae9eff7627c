// Up to eight curves over the last minute. Samples are drawn from typed arrays where they lie, once a frame of the
// screen, and the time axis runs on between two batches of samples.

import { css, html, nothing, unsafeCSS } from "lit";
import uPlot from "uplot";
import plotStyles from "uplot/dist/uPlot.min.css?inline";
import { QUANTITIES, type Quantity } from "../state/samples.ts";
import { save } from "../tools/files.ts";
import { colour } from "../ui/colour.ts";
import { base } from "../ui/styles.ts";
import { type Curve, name, options, resolve } from "./plot.ts";
import { Tab } from "./tab.ts";

/** What the chart shows, in seconds. */
const SPAN_S = 60;
export const MAX_CURVES = 8;
/** The running time axis never gets further behind or ahead of the newest sample. */
const MAX_DRIFT_S = 0.25;

export class Curves extends Tab {
  static override properties = {
    ...Tab.properties,
    compact: { type: Boolean, reflect: true },
    curves: { state: true },
    paused: { state: true },
    span: { state: true },
    known: { state: true },
  };
  declare compact: boolean;
  declare curves: Curve[];
  declare paused: boolean;
  declare span: number;
  /** Which quantities have had a sample, as one text, so that only news draw the buttons anew. */
  declare known: string;

  #plot: uPlot | null = null;
  #frame = 0;
  #drawn = -1;
  /** Device time at the right edge, and when it was so. */
  #edge = 0;
  #edgeAt = 0;
  #frozen: Float64Array[] | null = null;
  #frames = { since: 0, drawn: 0, rate: 0 };
  readonly #size = new ResizeObserver(() => this.#resize());
  readonly #theme = () => this.#build();

  static override styles = [
    unsafeCSS(plotStyles),
    base,
    css`
      .tools {
        margin-bottom: 6px;
      }
      .plot {
        position: relative;
        height: min(62vh, 620px);
      }
      :host([compact]) .plot {
        flex: 1;
        height: auto;
        min-height: 210px;
      }
      .panel {
        display: flex;
        flex-direction: column;
        height: 100%;
      }
      .pick {
        display: flex;
        flex-wrap: wrap;
        gap: 4px;
      }
      .pick button {
        gap: 6px;
        font-weight: 500;
      }
      .pick i {
        width: 14px;
        height: 3px;
        border-radius: 2px;
        background: var(--lamp-off);
      }
      select {
        width: auto;
      }
      .u-legend {
        font-size: 12px;
        text-align: left;
      }
      .u-legend th {
        font-weight: 500;
      }
      .u-legend th,
      .u-legend td {
        padding: 0 3px;
        border: 0;
      }
      .u-legend .u-value {
        min-width: 5.5em;
        text-align: right;
        font-variant-numeric: tabular-nums;
      }
    `,
  ];

  constructor() {
    super();
    this.compact = false;
    this.curves = [];
    this.paused = false;
    this.span = SPAN_S;
    this.known = "";
  }

  override connectedCallback(): void {
    super.connectedCallback();
    window.addEventListener("theme", this.#theme);
    this.#run();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    window.removeEventListener("theme", this.#theme);
    cancelAnimationFrame(this.#frame);
    this.#size.disconnect();
    this.#plot?.destroy();
    this.#plot = null;
  }

  override willUpdate(changed: Map<string, unknown>): void {
    super.willUpdate(changed);
    if (changed.has("catalog")) {
      const quantities: Quantity[] = this.compact ? ["position"] : ["position", "speed"];
      const curves = quantities.flatMap((quantity) => this.catalog.axes.map((axis) => ({ axis, quantity })));
      this.curves = curves.slice(0, MAX_CURVES);
    }
  }

  override firstUpdated(): void {
    this.#size.observe(this.renderRoot.querySelector(".plot")!);
  }

  override updated(changed: Map<string, unknown>): void {
    if (changed.has("curves") || changed.has("catalog")) this.#build();
  }

  override render() {
    return html`
      <section class="panel" aria-label="Chart">
        <div class="row tools">
          <h2>Chart</h2>
          ${this.compact ? this.#quantities() : html`
            <div class="pick" role="group" aria-label="Curves, at most ${MAX_CURVES}">
              ${QUANTITIES.map((quantity) => this.catalog.axes.map((axis) => this.#button({ axis, quantity })))}
            </div>`}
          <span class="grow"></span>
          <select aria-label="Time shown" @change=${(event: Event) => this.#setSpan(Number((event.target as HTMLSelectElement).value))}>
            ${[5, 10, 20, 60].map((span) => html`<option value=${span} ?selected=${span === this.span}>${span} s</option>`)}
          </select>
          <button class="small" aria-pressed=${this.paused} @click=${() => this.#pause(!this.paused)}>
            ${this.paused ? "▶ Run" : "❚❚ Pause"}
          </button>
          <button class="small" @click=${this.#saveCsv}>CSV</button>
          <button class="small" @click=${this.#savePng}>PNG</button>
        </div>
        <div class="plot" role="img" aria-label="Curves of ${this.curves.map(({ axis, quantity }) => `${axis} ${quantity}`).join(", ") || "nothing"}"></div>
        ${this.paused
          ? html`<p class="muted" role="status">Paused. Drag over the chart to zoom in, double click to zoom out.</p>`
          : nothing}
      </section>
    `;
  }

  /** One quantity of all axes, where there is little room. */
  #quantities() {
    const known = QUANTITIES.filter((quantity) => this.known.includes(` ${quantity},`));
    const shown = this.curves[0]?.quantity;
    return html`
      <select aria-label="What of all axes" @change=${(event: Event) => this.#showAllOf((event.target as HTMLSelectElement).value as Quantity)}>
        ${known.map((quantity) => html`<option ?selected=${quantity === shown}>${quantity}</option>`)}
      </select>
    `;
  }

  #showAllOf(quantity: Quantity): void {
    this.curves = this.catalog.axes.map((axis) => ({ axis, quantity }));
  }

  #button(curve: Curve) {
    const at = this.#place(curve);
    if (at < 0 && !this.known.includes(` ${name(curve)},`)) return nothing;
    return html`
      <button class="small" aria-pressed=${at >= 0} ?disabled=${at < 0 && this.curves.length >= MAX_CURVES}
        @click=${() => this.#toggle(curve)}>
        <i ${colour(at >= 0 ? `var(--curve-${at + 1})` : "")}></i>${curve.axis} ${curve.quantity}
      </button>
    `;
  }

  #place({ axis, quantity }: Curve): number {
    return this.curves.findIndex((curve) => curve.axis === axis && curve.quantity === quantity);
  }

  #toggle(curve: Curve): void {
    const at = this.#place(curve);
    this.curves = at < 0 ? [...this.curves, curve] : this.curves.filter((_, n) => n !== at);
  }

  #setSpan(span: number): void {
    this.span = span;
    this.#drawn = -1;
    if (this.paused) this.#showAll();
  }

  /** Pausing keeps what there is now: the ring goes on being written. */
  #pause(paused: boolean): void {
    this.#frozen = paused ? this.#columns().map((column) => column.slice()) : null;
    this.paused = paused;
    this.#drawn = -1;
    if (paused) this.#draw(this.#frozen!);
  }

  #columns(): Float64Array[] {
    const { samples } = this.live;
    return [samples.time(), ...this.curves.map(({ axis, quantity }) => samples.values(axis, quantity))];
  }

  /** Draws once a frame, if there is anything to draw. */
  #run(): void {
    this.#frame = requestAnimationFrame((now) => {
      this.#run();
      if (!this.active || this.paused || !this.#plot || document.hidden) return;
      const { samples } = this.live;
      if (samples.length === 0) return;
      if (samples.version !== this.#drawn) this.#learn();
      this.#advance(now);
      this.#draw(this.#columns());
      this.#count(now);
    });
  }

  /** Notes which quantities there are. */
  #learn(): void {
    const { samples } = this.live;
    this.#drawn = samples.version;
    let known = " ";
    for (const quantity of QUANTITIES) {
      for (const axis of this.catalog.axes) if (samples.has(axis, quantity)) known += `${axis} ${quantity}, `;
    }
    if (known !== this.known) this.known = known;
  }

  /** Moves the right edge on by the time that has passed, and no further from the newest sample than allowed. */
  #advance(now: number): void {
    const { last } = this.live.samples;
    const edge = this.#edge + (now - this.#edgeAt) / 1000;
    this.#edge = Math.abs(edge - last) > MAX_DRIFT_S ? last : edge;
    this.#edgeAt = now;
  }

  #draw(data: Float64Array[]): void {
    const plot = this.#plot!;
    plot.batch(() => {
      plot.setData(data as unknown as uPlot.AlignedData, false);
      if (!this.paused) plot.setScale("x", { min: this.#edge - this.span, max: this.#edge });
      else this.#showAll();
    });
    // Without a cursor the legend has the newest values.
    if ((plot.cursor.left ?? -1) < 0) plot.setLegend({ idx: data[0]!.length - 1 }, false);
  }

  #showAll(): void {
    const last = this.#frozen?.[0]?.at(-1) ?? 0;
    this.#plot?.setScale("x", { min: last - this.span, max: last });
  }

  /** Frames a second, for who measures: the attribute `data-fps`. */
  #count(now: number): void {
    const frames = this.#frames;
    frames.drawn += 1;
    if (now - frames.since < 1000) return;
    frames.rate = (frames.drawn * 1000) / (now - frames.since);
    frames.since = now;
    frames.drawn = 0;
    this.dataset["fps"] = frames.rate.toFixed(1);
  }

  #build(): void {
    const place = this.renderRoot.querySelector<HTMLElement>(".plot");
    if (!place || !this.catalog) return;
    this.#plot?.destroy();
    const size = { width: place.clientWidth || 600, height: this.#plotHeight(place) };
    // Who zooms wants to look at what there is.
    const zoomed = () => {
      if (!this.paused) this.#pause(true);
    };
    this.#plot = new uPlot(
      options(this, this.curves, this.catalog.units, size, zoomed),
      this.#columnsNow(),
      place,
    );
    place.querySelector(".u-legend")?.setAttribute("aria-label", "The newest values, or those at the cursor");
    if (this.paused) this.#showAll();
  }

  #columnsNow(): uPlot.AlignedData {
    if (this.paused) {
      // Another choice of curves shows what the ring still has.
      this.#frozen = this.#columns().map((column) => column.slice());
      return this.#frozen as unknown as uPlot.AlignedData;
    }
    return this.#columns() as unknown as uPlot.AlignedData;
  }

  #resize(): void {
    const place = this.renderRoot.querySelector<HTMLElement>(".plot")!;
    if (place.clientWidth > 0) this.#plot?.setSize({ width: place.clientWidth, height: this.#plotHeight(place) });
  }

  /** The legend stands below the drawing, a line for some curves. */
  #plotHeight(place: HTMLElement): number {
    const perLine = Math.max(1, Math.floor(place.clientWidth / 170));
    return place.clientHeight - 22 * Math.ceil((this.curves.length + 1) / perLine);
  }

  #saveCsv(): void {
    const columns = this.#frozen ?? this.#columns();
    const head = ["seconds", ...this.curves.map((curve) => name(curve))].join(",");
    const lines = Array.from(columns[0]!, (_, row) => columns.map((column) => column[row]).join(","));
    save(`${this.device.name}.csv`, [head, ...lines, ""].join("\n"), "text/csv");
  }

  #savePng(): void {
    const drawn = this.#plot!.ctx.canvas;
    const canvas = document.createElement("canvas");
    canvas.width = drawn.width;
    canvas.height = drawn.height;
    const context = canvas.getContext("2d")!;
    context.fillStyle = resolve(this, "var(--panel)");
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.drawImage(drawn, 0, 0);
    canvas.toBlob((blob) => {
      if (blob) save(`${this.device.name}.png`, blob, "image/png");
    });
  }
}
customElements.define("pt-curves", Curves);
