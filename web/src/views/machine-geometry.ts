// Where things of a machine are on the screen.

import type { MachineAxis, MovedSwitches } from "../api/contract.ts";

export type SwitchRole = "negative limit" | "home" | "positive limit";

/** Pixels left and right of the rail's ends. */
const MARGIN = 46;
/** What a stage without limits shows to each side of its shaft. */
const OPEN_REACH = 10_000;

/** A rail from pulses to pixels and back. */
export interface Lane {
  margin: number;
  low: number;
  high: number;
  perPulse: number;
  x(pulse: number): number;
  pulse(x: number): number;
}

/** The rail of a stage: from limit to limit with a little room, and further if the shaft is there. */
export function lane(axis: MachineAxis, width: number): Lane {
  const ends = [axis.negative_limit, axis.positive_limit, ...(axis.home ?? [])].filter((end) => end !== null);
  if (axis.negative_limit === null || axis.positive_limit === null) {
    // In steps, so that the drawing does not run with the shaft.
    const middle = Math.round(axis.shaft / OPEN_REACH) * OPEN_REACH;
    ends.push(middle - OPEN_REACH, middle + OPEN_REACH);
  }
  const low = Math.min(...ends, axis.shaft);
  const high = Math.max(...ends, axis.shaft);
  const perPulse = (width - 2 * MARGIN) / Math.max(1, high - low);
  return {
    margin: MARGIN,
    low,
    high,
    perPulse,
    x: (pulse) => MARGIN + (pulse - low) * perPulse,
    pulse: (x) => low + (x - MARGIN) / perPulse,
  };
}

/** Which part of a turn a pulse is at, from 0 to 1. */
export function around(axis: MachineAxis, pulse: number): number {
  const turn = axis.circumference!;
  return (((pulse % turn) + turn) % turn) / turn;
}

/** An SVG path along a circle between two pulses; 0 is at the top, and it goes clockwise. */
export function arc(axis: MachineAxis, [from, to]: [number, number], radius: number): string {
  const point = (part: number) => {
    const angle = part * 2 * Math.PI;
    return `${(Math.sin(angle) * radius).toFixed(2)} ${(-Math.cos(angle) * radius).toFixed(2)}`;
  };
  // Never so short that nobody sees it.
  const length = Math.min(0.999, Math.max((to - from) / axis.circumference!, 0.01));
  const start = around(axis, from);
  return `M ${point(start)} A ${radius} ${radius} 0 ${length > 0.5 ? 1 : 0} 1 ${point(start + length)}`;
}

/** Where a switch is mounted: the home switch in its middle. */
export function mount({ home, negative_limit, positive_limit }: MachineAxis, role: SwitchRole): number | null {
  switch (role) {
    case "negative limit":
      return negative_limit;
    case "positive limit":
      return positive_limit;
    case "home":
      return home && (home[0] + home[1]) / 2;
  }
}

/** How a switch is mounted whose middle comes to a pulse; the home switch stays as wide as it is. */
export function mountAt(axis: MachineAxis, role: SwitchRole, at: number): Omit<MovedSwitches, "axis"> {
  const pulse = Math.round(axis.circumference === null ? at : around(axis, at) * axis.circumference);
  switch (role) {
    case "negative limit":
      return { negative_limit: pulse };
    case "positive limit":
      return { positive_limit: pulse };
    case "home": {
      const wide = axis.home![1] - axis.home![0];
      const first = pulse - Math.floor(wide / 2);
      return { home: [first, first + wide] };
    }
  }
}

/** Whether the carriage presses a switch where that is mounted. */
export function touches(axis: MachineAxis, role: SwitchRole): boolean {
  const { shaft, home, negative_limit, positive_limit } = axis;
  switch (role) {
    case "negative limit":
      return negative_limit !== null && shaft <= negative_limit;
    case "positive limit":
      return positive_limit !== null && shaft >= positive_limit;
    case "home": {
      if (home === null) return false;
      if (axis.circumference === null) return home[0] <= shaft && shaft <= home[1];
      const behind = (around(axis, shaft) - around(axis, home[0]) + 1) % 1;
      return behind <= (home[1] - home[0]) / axis.circumference;
    }
  }
}

/** Whether a switch that is held somewhere is pressed by the carriage: a limit also behind it, the home switch near it. */
export function covers(axis: MachineAxis, role: SwitchRole, at: number): boolean {
  const half = axis.home ? Math.max(1, (axis.home[1] - axis.home[0]) / 2) : 1;
  if (axis.circumference !== null) {
    const apart = Math.abs(around(axis, at) - around(axis, axis.shaft));
    const reach = Math.max(half / axis.circumference, 0.01);
    return Math.min(apart, 1 - apart) <= reach;
  }
  if (role === "negative limit") return axis.shaft <= at;
  if (role === "positive limit") return axis.shaft >= at;
  // As wide as it is, and a hundredth of the rail at least: nobody hits a pulse with a mouse.
  const rail = (axis.positive_limit ?? 0) - (axis.negative_limit ?? 0);
  return Math.abs(axis.shaft - at) <= Math.max(half, rail / 100);
}
