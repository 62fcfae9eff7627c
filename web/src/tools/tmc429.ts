// The units of the TMC429: what its registers mean in pulses (microsteps), seconds and turns.
// (PD42-1140 firmware manual, section 6.1.)

/** Clock of the chip on the module. */
export const CLOCK_HZ = 16_000_000;

/** The largest speed and acceleration of a register. */
export const MAX_INTERNAL = 2047;

/** The largest pulse and ramp divisor. */
export const MAX_DIVISOR = 13;

/** Axis parameters 154 and 153. */
export interface Divisors {
  pulse: number;
  ramp: number;
}

/** Pulses a second of one internal unit of speed (equation 1). */
export function speedUnit(pulseDivisor: number): number {
  return CLOCK_HZ / (2 ** pulseDivisor * 2048 * 32);
}

/** Pulses a second, each second, of one internal unit of acceleration (equation 3). */
export function accelerationUnit({ pulse, ramp }: Divisors): number {
  return CLOCK_HZ ** 2 / 2 ** (ramp + pulse + 29);
}

/** The internal accelerations that positioning ramps can have; velocity mode has no such limits (section 6.1.3). */
export function accelerationRange({ pulse, ramp }: Divisors): [number, number] {
  const low = Math.max(2 ** (ramp - pulse - 1), 1);
  return [Math.min(Math.ceil(low), MAX_INTERNAL), Math.min(Math.max(2 ** (ramp - pulse + 12) - 1, 1), MAX_INTERNAL)];
}

/** The divisors that keep most of a register for this highest speed and acceleration (section 6.1.3). */
export function bestDivisors(topPps: number, topPps2: number): Divisors {
  const pulse = largest((divisor) => speedUnit(divisor) * MAX_INTERNAL >= topPps);
  const ramp = largest((divisor) => accelerationUnit({ pulse, ramp: divisor }) * MAX_INTERNAL >= topPps2);
  return { pulse, ramp };
}

function largest(fits: (divisor: number) => boolean): number {
  let divisor = MAX_DIVISOR;
  while (divisor > 0 && !fits(divisor)) divisor -= 1;
  return divisor;
}

/** Encoder counts of the SensOstep in a turn (section 6.2). */
export const SENSOSTEP_COUNTS = 1024;

/** Axis parameter 210 that makes the built-in encoder count microsteps (section 6.2.1). */
export function sensostepPrescaler(microsteps: number, fullStepsPerTurn: number): number {
  // The low four bits are special functions.
  return Math.round((fullStepsPerTurn * microsteps * 512) / SENSOSTEP_COUNTS / 16) * 16;
}

/** Axis parameter 217 that makes an external encoder count microsteps, to the nearest (section 6.3). */
export function externalPrescaler(microsteps: number, fullStepsPerTurn: number, countsPerTurn: number): number {
  return Math.round((fullStepsPerTurn * microsteps * 256) / countsPerTurn);
}
