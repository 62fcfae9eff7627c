// From a controller's parameters to how an axis moves and counts.

import type { Catalog, ParameterInfo, Role, Value } from "../api/contract.ts";
import * as pps from "./pps.ts";
import type { Move } from "./profile.ts";
import { accelerationRange, accelerationUnit, type Divisors, speedUnit } from "./tmc429.ts";
import type { Counting } from "./units.ts";

/** Values of parameters by id. */
export type Values = Readonly<Record<string, Value>>;

/** Axis parameters of the TMC429 that decide over a ramp. */
const AP = { topSpeed: 4, acceleration: 5, stopSpeed: 130, mode: 138, microsteps: 140, ramp: 153, pulse: 154 } as const;

/** Axis parameter 138 for the exponential approach. */
const SOFT = 1;

/** What decides how an axis moves whose ramps are pulses a second: its own settings, and where those are 0 the common ones. */
const ROLES: (Role | null)[] = [
  "high_speed", "low_speed", "acceleration", "deceleration", "own_deceleration", "s_curve", "speed_window", "closed_loop",
  "closed_loop_ratio",
];

/** The parameters that decide how an axis moves, as far as the model has them. */
export function deciding(catalog: Catalog, axis: string): ParameterInfo[] {
  if (catalog.language === "tmcl") return named(catalog, Object.values(AP).map((number) => `AP${number}.${axis}`));
  return catalog.parameters.filter((info) => ROLES.includes(info.role) && (info.axis === axis || info.axis === null));
}

/** The value of what has this role for an axis, its own or the common one. */
function valueOf(catalog: Catalog, axis: string, values: Values, what: Role): number {
  const those = catalog.parameters.filter(({ role }) => role === what);
  const of = (owner: string | null) => those.find((info) => info.axis === owner)?.id ?? "";
  return number(values, of(axis)) || number(values, of(null));
}

/** The parameters with these ids, in this order; those that a model lacks are left out. */
export function named(catalog: Catalog, ids: readonly string[]): ParameterInfo[] {
  const known = new Map(catalog.parameters.map((info) => [info.id, info]));
  return ids.map((id) => known.get(id)).filter((info) => info !== undefined);
}

/** How an axis counts. */
export function counting(catalog: Catalog, axis: string, values: Values): Counting {
  if (catalog.language === "tmcl") return { divisors: divisors(axis, values) };
  const ratio = valueOf(catalog, axis, values, "closed_loop_ratio");
  return ratio > 0 ? { pulsesPerCount: ratio } : {};
}

/** Microsteps of a full step, where the controller decides that. */
export function microsteps(catalog: Catalog, axis: string, values: Values): number | null {
  const exponent = values[`AP${AP.microsteps}.${axis}`];
  return catalog.language === "tmcl" && typeof exponent === "number" ? 2 ** exponent : null;
}

/** A move as these settings make it, and what is to be said of it, a sentence each. */
export interface Plan {
  move: Move;
  notes: string[];
}

/** A move over so many units of position. */
export function plan(catalog: Catalog, axis: string, values: Values, distance: number): Plan {
  return catalog.language === "tmcl"
    ? registers(axis, values, distance)
    : pulses(catalog, axis, values, distance);
}

function registers(axis: string, values: Values, distance: number): Plan {
  const get = (parameter: keyof typeof AP) => number(values, `AP${AP[parameter]}.${axis}`);
  const div = divisors(axis, values);
  const unit = speedUnit(div.pulse);
  const acceleration = get("acceleration") * accelerationUnit(div);
  const notes: string[] = [];
  const [low, high] = accelerationRange(div);
  if (get("acceleration") < low || get("acceleration") > high) {
    notes.push(`With these divisors positioning ramps have accelerations from ${low} to ${high}.`);
  }
  if (get("mode") === SOFT) notes.push("The soft approach to the target (ramp mode 1) takes longer than shown.");
  return {
    notes,
    move: {
      pulses: distance,
      // A ramp of the chip begins with the least speed that it has.
      startPps: unit,
      stopPps: get("stopSpeed") * unit,
      topPps: get("topSpeed") * unit,
      acceleration,
      deceleration: acceleration,
      sCurve: false,
    },
  };
}

function pulses(catalog: Catalog, axis: string, values: Values, distance: number): Plan {
  const get = (role: Role) => valueOf(catalog, axis, values, role);
  const accelerationMs = get("acceleration");
  // Where a setting says whether the deceleration is one of its own; other models always have one.
  const rule = catalog.parameters.some(({ role }) => role === "own_deceleration");
  const own = !rule || get("own_deceleration") !== 0;
  const made = pps.move(
    {
      highPps: get("high_speed"),
      lowPps: get("low_speed"),
      accelerationMs,
      decelerationMs: own ? get("deceleration") : accelerationMs,
      sCurve: get("s_curve") !== 0,
      window: get("speed_window"),
      pulsesPerCount: get("closed_loop") !== 0 ? get("closed_loop_ratio") || 1 : null,
    },
    distance,
    catalog.speed_windows,
  );
  return { move: made.move, notes: made.notes };
}

function divisors(axis: string, values: Values): Divisors {
  return { pulse: number(values, `AP${AP.pulse}.${axis}`), ramp: number(values, `AP${AP.ramp}.${axis}`) };
}

function number(values: Values, id: string): number {
  const value = values[id];
  return typeof value === "number" ? value : 0;
}
