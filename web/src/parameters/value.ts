// Values of parameters as text: what a person types, within what the table allows.

import type { ParameterInfo, Value } from "../api/contract.ts";

/** The longest text of a parameter. */
const MAX_TEXT = 64;

export type Entered = { ok: true; value: Value } | { ok: false; problem: string };

/** Whether a number may be a parameter's value: a sentence if not. */
export function check(info: ParameterInfo, value: Value): string | null {
  if (info.is_text !== (typeof value === "string")) return info.is_text ? "This is text." : "This is a number.";
  if (typeof value === "string") return value.length <= MAX_TEXT ? null : `At most ${MAX_TEXT} characters.`;
  if (!Number.isFinite(value)) return "This is a number.";
  if (Number(value.toFixed(info.decimals)) !== value) {
    return info.decimals === 0 ? "Whole numbers only." : `At most ${info.decimals} decimals.`;
  }
  if (info.low !== null && value < info.low) return `At least ${info.low}.`;
  if (info.high !== null && value > info.high) return `At most ${info.high}.`;
  return null;
}

/** What was typed, as a value. Whole numbers may be hexadecimal (`0x1F`). */
export function parse(info: ParameterInfo, text: string): Entered {
  const trimmed = text.trim();
  const value = info.is_text ? trimmed : number(trimmed);
  if (value === null) return { ok: false, problem: "This is a number." };
  const problem = check(info, value);
  return problem === null ? { ok: true, value } : { ok: false, problem };
}

function number(text: string): number | null {
  const plain = text.replace("\u2212", "-").replace(/[\s_\u2009]/g, "");
  const hex = /^(-?)0x([0-9a-f]+)$/i.exec(plain);
  if (hex) return (hex[1] === "-" ? -1 : 1) * Number.parseInt(hex[2] ?? "", 16);
  return /^[+-]?(\d+\.?\d*|\.\d+)$/.test(plain) ? Number(plain) : null;
}

/** A value as the table shows it. */
export function shown(info: ParameterInfo, value: Value): string {
  return typeof value === "string" ? value : value.toFixed(info.decimals);
}

/** The range in words; empty without one. */
export function range({ low, high, is_text }: ParameterInfo): string {
  if (is_text) return "text";
  if (low === null && high === null) return "";
  const whole = low === -(2 ** 31) && high === 2 ** 31 - 1;
  return whole ? "32 bits" : `${low ?? "…"} to ${high ?? "…"}`;
}
