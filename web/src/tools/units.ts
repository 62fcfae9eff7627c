// Between a controller's units and those of a machine builder. Every unit is linear: a table of factors says it all,
// and any unit converts into any other through the pulse.

import { accelerationUnit, MAX_INTERNAL, speedUnit, type Divisors } from "./tmc429.ts";

/** What turns when the motor does. */
export interface Drive {
  /** Full steps a turn: 200 for a motor of 1.8°. */
  fullSteps: number;
  /** Microsteps a full step: pulses that the drive takes for one. */
  microsteps: number;
  /** Way of the load in a turn of the motor: the lead of a spindle, the circumference of a pulley. */
  mmPerTurn: number;
}

/** A unit of a quantity. */
export interface Unit {
  id: string;
  /** As it stands behind a number. */
  label: string;
  name: string;
  /** Pulses (a second, each second) of one unit. */
  pulses: number;
  /** For a register: the values that it takes, whole numbers. */
  range?: readonly [number, number];
}

/** What is converted. */
export type Quantity = "position" | "speed" | "acceleration";

/** Pulses in a turn of the motor. */
export function pulsesPerTurn(drive: Drive): number {
  return drive.fullSteps * drive.microsteps;
}

/** How a controller counts besides pulses: the TMC429 in registers, a closed loop in encoder counts. */
export interface Counting {
  divisors?: Divisors;
  /** StepNLoop: pulses of an encoder count (PMX-2ED-SA manual, 7.17; CMD-4CR manual, 2.3). */
  pulsesPerCount?: number;
}

/** The units of a quantity, the controller's own first. */
export function units(quantity: Quantity, drive: Drive, counting: Counting): Unit[] {
  const turn = pulsesPerTurn(drive);
  const per = { position: "", speed: "/s", acceleration: "/s²" }[quantity];
  const list: Unit[] = [];
  const add = (id: string, label: string, name: string, pulses: number, range?: Unit["range"]) => {
    if (Number.isFinite(pulses) && pulses > 0) list.push({ id, label, name, pulses, ...(range && { range }) });
  };
  const { divisors, pulsesPerCount } = counting;
  if (divisors !== undefined && quantity === "speed") {
    add("int", "int", "Internal speed", speedUnit(divisors.pulse), [-MAX_INTERNAL, MAX_INTERNAL]);
  }
  if (divisors !== undefined && quantity === "acceleration") {
    add("int", "int", "Internal acceleration", accelerationUnit(divisors), [0, MAX_INTERNAL]);
  }
  add("pulses", { position: "pulses", speed: "pps", acceleration: "pps²" }[quantity], "Pulses", 1);
  if (pulsesPerCount !== undefined) add("counts", `counts${per}`, "Encoder counts", pulsesPerCount);
  add("full", `full steps${per}`, "Full steps", drive.microsteps);
  add("turns", `turns${per}`, "Turns of the motor", turn);
  if (quantity === "position") add("degrees", "°", "Degrees", turn / 360);
  if (quantity === "speed") add("rpm", "rpm", "Turns a minute", turn / 60);
  if (quantity === "acceleration") add("rpm", "rpm/s", "Turns a minute, each second", turn / 60);
  add("mm", `mm${per}`, "Millimetres of the load", turn / drive.mmPerTurn);
  return list;
}

/** A value of one unit in all others. A register shows the nearest that it can hold, `exact` says what it should. */
export interface Converted {
  unit: Unit;
  exact: number;
  /** What the unit shows: `exact`, or what a register holds. */
  shown: number;
  /** Whether the register holds it at all. */
  fits: boolean;
}

/** A value in every unit of the list. */
export function convert(value: number, from: Unit, into: readonly Unit[]): Converted[] {
  const pulses = value * from.pulses;
  return into.map((unit) => {
    const exact = pulses / unit.pulses;
    if (unit.range === undefined) return { unit, exact, shown: exact, fits: Number.isFinite(exact) };
    const [low, high] = unit.range;
    const whole = Math.round(exact);
    return { unit, exact, shown: Math.min(Math.max(whole, low), high), fits: whole >= low && whole <= high };
  });
}

/** A number for people: seven significant digits, without an exponent where it can be read without. */
export function readable(value: number): string {
  if (!Number.isFinite(value)) return "–";
  const short = Number(value.toPrecision(7));
  const size = Math.abs(short);
  return size !== 0 && (size >= 1e12 || size < 1e-6) ? short.toExponential() : short.toString();
}
