// The load value over the last seconds, with the thresholds of CoolStep.

import { LitElement, css, html } from "lit";
import type { LiveStore } from "../state/live.ts";
import { base } from "../ui/styles.ts";
import { MAX_LOAD } from "./load.ts";

/** What is shown, in seconds. */
const SPAN_S = 20;
/** Room for the numbers at the left. */
const LEFT = 44;
const MARKS = [0, 256, 512, 768, MAX_LOAD];

/** `<pt-load-curve>` draws itself anew with each frame of the screen in which there is something new. */
class LoadCurve extends LitElement {
  static override properties = {
    live: { attribute: false },
    axis: { type: String },
    active: { type: Boolean },
    thresholds: { attribute: false },
  };
  declare live: LiveStore;
  declare axis: string;
  declare active: boolean;
  /** Below the first the current grows, above the second it falls. */
  declare thresholds: [number, number] | null;
  #frame = 0;
  #drawn = "";

  static override styles = [
    base,
    css`
      canvas {
        display: block;
        width: 100%;
        height: 240px;
        border: 1px solid var(--line);
        border-radius: var(--radius);
      }
    `,
  ];

  constructor() {
    super();
    this.axis = "";
    this.active = false;
    this.thresholds = null;
  }

  override connectedCallback(): void {
    super.connectedCallback();
    this.#frame = requestAnimationFrame(() => this.#tick());
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    cancelAnimationFrame(this.#frame);
  }

  #tick(): void {
    this.#frame = requestAnimationFrame(() => this.#tick());
    const canvas = this.renderRoot.querySelector("canvas");
    if (!canvas || !this.active) return;
    const width = Math.round(canvas.clientWidth * devicePixelRatio);
    const height = Math.round(canvas.clientHeight * devicePixelRatio);
    const dark = document.documentElement.dataset["theme"] ?? matchMedia("(prefers-color-scheme: dark)").matches;
    const state = [this.live.samples.version, this.axis, width, height, this.thresholds, dark].join();
    if (state === this.#drawn || width === 0) return;
    this.#drawn = state;
    canvas.width = width;
    canvas.height = height;
    this.#draw(canvas, width / devicePixelRatio, height / devicePixelRatio);
  }

  #draw(canvas: HTMLCanvasElement, width: number, height: number): void {
    const paint = canvas.getContext("2d");
    if (!paint) return;
    // A colour that follows dark and light is only known to an element that has it.
    const colour = (name: string) => {
      canvas.style.color = `var(${name})`;
      return getComputedStyle(canvas).color;
    };
    const samples = this.live.samples;
    const x = (seconds: number) => LEFT + ((seconds - samples.last + SPAN_S) / SPAN_S) * (width - LEFT);
    const y = (load: number) => height - 8 - (load / MAX_LOAD) * (height - 16);
    paint.scale(devicePixelRatio, devicePixelRatio);
    paint.font = "12px sans-serif";
    paint.textAlign = "right";
    for (const load of MARKS) {
      paint.fillStyle = colour("--muted");
      paint.fillText(String(load), LEFT - 6, y(load) + 4);
      paint.strokeStyle = colour("--line");
      line(paint, [LEFT, y(load)], [width, y(load)]);
    }
    if (this.thresholds) {
      const [low, high] = this.thresholds;
      paint.globalAlpha = 0.18;
      paint.fillStyle = colour("--ok");
      paint.fillRect(LEFT, y(high), width - LEFT, y(low) - y(high));
      paint.globalAlpha = 1;
      paint.strokeStyle = colour("--ok");
      for (const at of [low, high]) line(paint, [LEFT, y(at)], [width, y(at)]);
    }
    if (!samples.has(this.axis, "load")) return;
    const times = samples.time();
    const loads = samples.values(this.axis, "load");
    paint.strokeStyle = colour("--curve-1");
    paint.lineWidth = 1.8;
    paint.beginPath();
    for (let n = 0; n < times.length; n += 1) {
      const at = x(times[n] ?? 0);
      if (at >= LEFT) paint.lineTo(at, y(loads[n] ?? 0));
    }
    paint.stroke();
  }

  override render() {
    return html`<canvas role="img" aria-label="Load value over the last ${SPAN_S} seconds"></canvas>`;
  }
}
customElements.define("pt-load-curve", LoadCurve);

function line(paint: CanvasRenderingContext2D, from: [number, number], to: [number, number]): void {
  paint.beginPath();
  paint.moveTo(...from);
  paint.lineTo(...to);
  paint.stroke();
}
