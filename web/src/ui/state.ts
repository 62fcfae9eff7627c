// What colour a state has. The word always stands beside it.

import type { AxisStatus } from "../api/contract.ts";

export type Tone = "" | "ok" | "busy" | "warn" | "error";

/** Error, moving, standing with its motor on, or switched off. */
export function stateKind(axis: AxisStatus): Tone {
  if (axis.error !== null) return "error";
  if (axis.speed !== 0 || !/^(idle|standing|off)/i.test(axis.state)) return "busy";
  return axis.enabled === false ? "" : "ok";
}
