// The ratio of StepNLoop: pulses of a motor for a count of its encoder. (PMX-2ED-SA manual, 7.17; CMD-4CR manual, 2.3.)

/** Decimals of SLR, and its range. */
export const DECIMALS = 3;
export const RANGE = [0.001, 999.999] as const;

/** How far a move got: what the pulse counter and the encoder counted. */
export interface Trial {
  pulses: number;
  counts: number;
}

export type Ratio =
  | { ok: true; ratio: number; exact: number; spread: number }
  | { ok: false; reason: "no encoder" | "wrong way" | "out of range"; exact: number };

/** The ratio of some moves there and back. Their encoder counts may have an error of a count at either end each. */
export function ratio(trials: readonly Trial[]): Ratio {
  const ways = trials.filter(({ pulses }) => pulses !== 0);
  const pulses = ways.reduce((sum, trial) => sum + Math.abs(trial.pulses), 0);
  // Counts in the direction of the pulses are positive.
  const counts = ways.reduce((sum, trial) => sum + trial.counts * Math.sign(trial.pulses), 0);
  const exact = pulses / counts;
  if (counts === 0 || pulses === 0) return { ok: false, reason: "no encoder", exact: Infinity };
  if (exact < 0) return { ok: false, reason: "wrong way", exact };
  const rounded = Number(exact.toFixed(DECIMALS));
  if (rounded < RANGE[0] || rounded > RANGE[1]) return { ok: false, reason: "out of range", exact };
  const each = ways.map((trial) => Math.abs(trial.pulses / trial.counts));
  return { ok: true, ratio: rounded, exact, spread: Math.max(...each) - Math.min(...each) };
}

/** What to do about a ratio that is none. */
export const ADVICE: Record<"no encoder" | "wrong way" | "out of range", string> = {
  "no encoder": "The encoder did not count. Is it connected, has it power, and does the motor turn?",
  "wrong way": "The encoder counts against the motor. Invert the direction or the encoder in the polarity (POL).",
  "out of range": `The ratio is outside ${RANGE[0]} to ${RANGE[1]}. Choose another microstepping or encoder decoding.`,
};
