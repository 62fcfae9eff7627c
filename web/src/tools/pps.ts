// How the ASCII controllers move: pulses a second, and milliseconds from the low speed to the high one. (PMX-2ED-SA
// manual, 7.1, 7.17 and appendix A; CMD-4CR manual, 2.1.4 and appendix B.)

import type { SpeedWindow } from "../api/contract.ts";
import type { Move } from "./profile.ts";

/** The settings of an axis that decide how it moves. */
export interface Settings {
  highPps: number;
  lowPps: number;
  accelerationMs: number;
  decelerationMs: number;
  sCurve: boolean;
  /** Number of the window chosen for changes on the way (SSPDM); 0 for none. */
  window: number;
  /** Pulses of an encoder count while StepNLoop is on: settings and targets are in counts then. */
  pulsesPerCount: number | null;
}

/** The window of a high speed: the slower one at a border, the last one beyond the end. */
export function windowOf(windows: readonly SpeedWindow[], highPps: number): SpeedWindow | null {
  return windows.find(({ to_pps }) => highPps <= to_pps) ?? windows.at(-1) ?? null;
}

/** The shortest and the longest ramp between two speeds, in milliseconds. */
export function rampRange(window: SpeedWindow, lowPps: number, highPps: number): [number, number] {
  const longest = Math.floor((Math.max(highPps - lowPps, 0) * 1000) / window.delta);
  return [window.least_ms, Math.max(longest, window.least_ms)];
}

/** What a controller makes of its settings for a move over so many units of position. */
export interface Made {
  move: Move;
  /** Ramps after all rules, in milliseconds. */
  accelerationMs: number;
  decelerationMs: number;
  window: SpeedWindow | null;
  /** What differs from what was set, a sentence each. */
  notes: string[];
}

/** Settings, table of speeds and way to a move. */
export function move(settings: Settings, distance: number, windows: readonly SpeedWindow[]): Made {
  const ratio = settings.pulsesPerCount ?? 1;
  const notes: string[] = [];
  const pulses = Math.abs(distance) * ratio;
  const asked = settings.highPps * ratio;
  const window = windows.find(({ number }) => number === settings.window) ?? windowOf(windows, asked);
  const step = window?.step_pps ?? 1;
  const stepped = (pps: number) => Math.max(pps - (pps % step), step);
  const highPps = stepped(Math.min(asked, window?.to_pps ?? asked));
  const lowPps = Math.min(stepped(Math.max(settings.lowPps * ratio, window?.least_low_pps ?? 0)), highPps);
  const clamp = (ms: number, name: string) => {
    if (window === null) return ms;
    const [least, longest] = rampRange(window, lowPps, highPps);
    const clamped = Math.min(Math.max(ms, least), longest);
    if (clamped !== ms) notes.push(`${name} of ${ms} ms becomes ${clamped} ms at these speeds.`);
    return clamped;
  };
  const accelerationMs = clamp(settings.accelerationMs, "Acceleration");
  let decelerationMs = clamp(settings.decelerationMs, "Deceleration");
  // The way of a ramp is its time by the mean speed. Where either alone takes more than half, both are the first.
  const half = (1000 * pulses) / 2;
  const mean = (lowPps + highPps) / 2;
  if (decelerationMs !== accelerationMs && Math.max(accelerationMs, decelerationMs) * mean > half) {
    notes.push("A ramp needs more than half of the way: the deceleration is that of the acceleration.");
    decelerationMs = accelerationMs;
  }
  const rate = (ms: number) => ((highPps - lowPps) * 1000) / ms;
  return {
    accelerationMs,
    decelerationMs,
    window,
    notes,
    move: {
      pulses,
      startPps: lowPps,
      stopPps: lowPps,
      topPps: highPps,
      acceleration: rate(accelerationMs),
      deceleration: rate(decelerationMs),
      sCurve: settings.sCurve,
    },
  };
}
