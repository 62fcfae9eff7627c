// StallGuard2 and CoolStep: what their parameters mean in values of load and in current. (PD42-1140 firmware manual,
// chapter 4, axis parameters 168 to 183, and sections 7.2 and 7.3.)

/** The reading at no load at most; 0 is a stall. */
export const MAX_LOAD = 1023;

/** A step of the CoolStep thresholds. */
const THRESHOLD_STEP = 32;

/** The numbers of the axis parameters by what they are to this module. */
export const AP = {
  maxCurrent: 6,
  standbyCurrent: 7,
  minimum: 168,
  down: 169,
  hysteresis: 170,
  up: 171,
  start: 172,
  filter: 173,
  threshold: 174,
  actualCurrent: 180,
  stopSpeed: 181,
  coolStepSpeed: 182,
  slowCurrent: 183,
  load: 206,
} as const;

/** Between these readings CoolStep leaves the current alone: below it grows, above it falls. Null while it is off. */
export function thresholds(start: number, hysteresis: number): [number, number] | null {
  return start === 0 ? null : [start * THRESHOLD_STEP, (start + hysteresis + 1) * THRESHOLD_STEP];
}

/** Readings above the upper threshold for a step down (axis parameter 169). */
export const READINGS_A_STEP = [32, 8, 2, 1] as const;

/** Steps up for a reading below the lower threshold (axis parameter 171). */
export const STEPS_A_READING = [1, 2, 4, 8] as const;

/** A current parameter (0 to 255) in 32nds of the full current of the module, which is how it is set. */
export function current32(value: number): number {
  return (value >> 3) + 1;
}

/** The range of currents that CoolStep chooses from, in 32nds. */
export function coolStepRange(maxCurrent: number, minimum: number): [number, number] {
  const most = current32(maxCurrent);
  return [Math.max(most >> (minimum === 0 ? 1 : 2), 1), most];
}

/** Readings while the motor turned evenly. */
export interface Readings {
  count: number;
  least: number;
  most: number;
  mean: number;
}

/** Sums readings up; null without any. */
export function sum(values: readonly number[]): Readings | null {
  if (values.length === 0) return null;
  const mean = values.reduce((all, value) => all + value, 0) / values.length;
  return { count: values.length, least: Math.min(...values), most: Math.max(...values), mean };
}

/** Where the threshold stands, judged by readings without load (first) and at the load that must still be moved. */
export function judge(free: Readings | null, loaded: Readings | null): string {
  if (free === null) return "Run the motor at its working speed without load.";
  if (free.most >= MAX_LOAD) return "The reading is at its end: lower the threshold until it is not.";
  if (free.least === 0) return "The motor would stop without load: raise the threshold.";
  if (loaded === null) return "Now brake the motor with the highest load that it must still move.";
  if (loaded.least === 0) return "This load counts as a stall: raise the threshold.";
  if (loaded.mean >= free.mean) return "The reading does not fall with the load: choose another speed or current.";
  if (loaded.least > free.mean / 3) return "There is room: lower the threshold until the reading is just above 0 at this load.";
  return "The threshold fits: the reading stays above 0 at this load, and a stall is seen soon beyond it.";
}
