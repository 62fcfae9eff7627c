// What a move will look like, before it is made: its times, its highest speed, and the curves.
//
// A ramp is given by how long it takes from one speed to another; that is all the shapes differ in here. A move that is
// too short for its top speed has the peak at which the ways of its two ramps are the whole way.

/** The speeds of a move. */
export interface Move {
  /** Way, in pulses; the sign does not matter. */
  pulses: number;
  /** Speed at its beginning, in pulses a second. */
  startPps: number;
  /** Speed at its end. */
  stopPps: number;
  topPps: number;
  /** In pulses a second, each second. */
  acceleration: number;
  deceleration: number;
  /** Whether the ramps are S-curves without a straight part, which take as long as straight ones. */
  sCurve: boolean;
}

/** A ramp between two speeds. */
interface Ramp {
  low: number;
  high: number;
  seconds: number;
  sCurve: boolean;
}

/** A move that was worked out. */
export interface Profile {
  up: Ramp;
  cruiseSeconds: number;
  down: Ramp;
  peakPps: number;
  seconds: number;
  pulses: number;
  /** Whether the top speed is reached. */
  reached: boolean;
}

/** A point of the curves. */
export interface Point {
  seconds: number;
  pps: number;
  pulses: number;
}

/**
 * Seconds of a ramp to a peak below the top. Straight ones keep their acceleration. An S keeps its jerk: the time of a
 * bend goes with the root of its span of speed.
 */
function rampSeconds(low: number, peak: number, top: number, acceleration: number, sCurve: boolean): number {
  const span = Math.max(peak - low, 0);
  const whole = Math.max(top - low, 0);
  if (span === 0 || acceleration <= 0) return 0;
  return sCurve ? (whole / acceleration) * Math.sqrt(span / whole) : span / acceleration;
}

/** The ways of ramps of either shape are their times by the mean speed. */
function way({ low, high, seconds }: Ramp): number {
  return ((low + high) / 2) * seconds;
}

/** Works a move out. */
export function profile(move: Move): Profile {
  const { sCurve, topPps: top } = move;
  const pulses = Math.abs(move.pulses);
  const start = Math.min(move.startPps, top);
  const stop = Math.min(move.stopPps, top);
  const ramps = (peak: number): [Ramp, Ramp] => [
    { low: start, high: peak, seconds: rampSeconds(start, peak, top, move.acceleration, sCurve), sCurve },
    { low: stop, high: peak, seconds: rampSeconds(stop, peak, top, move.deceleration, sCurve), sCurve },
  ];
  const need = (peak: number) => ramps(peak).reduce((sum, ramp) => sum + way(ramp), 0);
  const reached = need(top) <= pulses;
  const peak = reached ? top : bisect(Math.max(start, stop), top, (speed) => need(speed) <= pulses);
  const [up, down] = ramps(peak);
  const left = Math.max(pulses - way(up) - way(down), 0);
  const cruiseSeconds = peak > 0 ? left / peak : 0;
  return { up, cruiseSeconds, down, peakPps: peak, seconds: up.seconds + cruiseSeconds + down.seconds, pulses, reached };
}

/** The largest number between two for which a condition still holds that holds up to some number. */
function bisect(low: number, high: number, holds: (number: number) => boolean): number {
  // A double has 53 bits: more halvings change nothing.
  for (let halving = 0; halving < 60; halving += 1) {
    const middle = (low + high) / 2;
    if (holds(middle)) low = middle;
    else high = middle;
  }
  return low;
}

/** Speed and way on a ramp, some seconds from its slow end. */
function along(ramp: Ramp, seconds: number): [number, number] {
  const { low, high } = ramp;
  if (ramp.seconds === 0) return [high, 0];
  const u = Math.min(Math.max(seconds / ramp.seconds, 0), 1);
  const span = high - low;
  // Share of the speed gained, and its integral over the share of time.
  const gained = !ramp.sCurve ? u : u < 0.5 ? 2 * u * u : 1 - 2 * (1 - u) ** 2;
  const area = !ramp.sCurve ? (u * u) / 2 : u < 0.5 ? (2 / 3) * u ** 3 : u - 0.5 + (2 / 3) * (1 - u) ** 3;
  return [low + span * gained, (low * u + span * area) * ramp.seconds];
}

/** Where the move is after some seconds. */
export function at(profile: Profile, seconds: number): Point {
  const { up, down, cruiseSeconds, peakPps } = profile;
  const clamped = Math.min(Math.max(seconds, 0), profile.seconds);
  if (clamped <= up.seconds) {
    const [pps, pulses] = along(up, clamped);
    return { seconds: clamped, pps, pulses };
  }
  if (clamped <= up.seconds + cruiseSeconds) {
    return { seconds: clamped, pps: peakPps, pulses: way(up) + (clamped - up.seconds) * peakPps };
  }
  const [pps, left] = along(down, profile.seconds - clamped);
  return { seconds: clamped, pps, pulses: profile.pulses - left };
}

/** Points of the curves: so many evenly in time, the ends included, and the corners between ramps and cruise. */
export function points(profile: Profile, count: number): Point[] {
  const even = Array.from({ length: count }, (_, n) => (profile.seconds * n) / (count - 1));
  const corners = [profile.up.seconds, profile.up.seconds + profile.cruiseSeconds];
  return [...even, ...corners].sort((a, b) => a - b).map((seconds) => at(profile, seconds));
}
