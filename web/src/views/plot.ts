// How curves are drawn: scales, axes and colours of uPlot.

import type uPlot from "uplot";
import type { Catalog } from "../api/contract.ts";
import { reading } from "../state/format.ts";
import type { Quantity } from "../state/samples.ts";

/** A quantity of an axis. */
export interface Curve {
  axis: string;
  quantity: Quantity;
}

/** Which scale a quantity is drawn against. */
const SCALE: Record<Quantity, string> = {
  position: "position",
  encoder: "position",
  speed: "speed",
  delta: "delta",
  load: "load",
};

/** What a curve is called. */
export function name({ axis, quantity }: Curve): string {
  return `${axis} ${quantity}`;
}

/** The drawing of some curves; `zoomed` is called when a part of the time was chosen, before it is shown. */
export function options(
  host: HTMLElement,
  curves: Curve[],
  units: Catalog["units"],
  size: { width: number; height: number },
  zoomed: () => void,
): uPlot.Options {
  const font = `11px ${getComputedStyle(host).fontFamily}`;
  const ink = resolve(host, "var(--muted)");
  const grid = { stroke: resolve(host, "var(--line)"), width: 1 };
  const unit: Record<string, string> = { position: units.position, speed: units.speed, delta: units.encoder };
  const scales = [...new Set(curves.map(({ quantity }) => SCALE[quantity]))];
  return {
    ...size,
    pxAlign: 0,
    cursor: { drag: { x: true, y: false }, points: { size: 6 } },
    hooks: { setSelect: [(plot) => void (plot.select.width > 0 && zoomed())] },
    scales: {
      x: { time: false, auto: false },
      ...Object.fromEntries(scales.map((scale) => [scale, { range: padded }])),
    },
    axes: [
      {
        stroke: ink,
        grid,
        ticks: grid,
        font,
        space: 80,
        // There is nothing before a device was switched on.
        values: (_, ticks) => ticks.map((tick) => (tick < 0 ? "" : `${tick} s`)),
      },
      ...scales.map((scale, n) => ({
        scale,
        side: (n % 2 === 0 ? 3 : 1) as 1 | 3,
        stroke: ink,
        grid: n === 0 ? grid : { show: false },
        ticks: grid,
        font,
        values: (_: uPlot, ticks: number[]) => ticks.map(reading),
        size: 72,
        label: unit[scale] ? `${scale} · ${unit[scale]}` : scale,
        labelFont: font,
        labelSize: 18,
      })),
    ],
    series: [
      { label: "time", value: (_, value) => (value === null ? "–" : `${value.toFixed(3)} s`) },
      ...curves.map((curve, n) => ({
        label: name(curve),
        scale: SCALE[curve.quantity],
        stroke: resolve(host, `var(--curve-${n + 1})`),
        width: 1.5,
        points: { show: false },
        value: (_: uPlot, value: number | null) => reading(value),
      })),
    ],
  };
}

/** A colour of the theme as a canvas wants it. */
export function resolve(host: HTMLElement, value: string): string {
  const probe = document.createElement("i");
  probe.style.color = value;
  host.shadowRoot!.append(probe);
  const { color } = getComputedStyle(probe);
  probe.remove();
  return color;
}

/** A little room above and below, and never an empty range. */
function padded(_: uPlot, low: number | null, high: number | null): [number, number] {
  if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) return [0, 1];
  const room = Math.max((high - low) * 0.06, 1);
  return [low - room, high + room];
}
