// Numbers as people read them.

const whole = new Intl.NumberFormat("en", { maximumFractionDigits: 0, useGrouping: true });

/** A whole number with thin spaces between thousands and a true minus; a dash if there is none. */
export function count(value: number | null | undefined): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  return whole.format(value).replaceAll(",", "\u2009").replace("-", "\u2212");
}

/** A number with so many decimals. */
export function decimal(value: number | null | undefined, decimals: number): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  return value.toFixed(decimals).replace("-", "\u2212");
}

/** A number with the decimals that it has, two at most. */
export function reading(value: number | null): string {
  return value === null || Number.isInteger(value) ? count(value) : decimal(Number(value.toFixed(2)), Number.isInteger(value * 10) ? 1 : 2);
}

/** Device time as h:mm:ss.t. */
export function clock(seconds: number): string {
  const tenths = Math.floor(seconds * 10);
  const two = (n: number) => String(n).padStart(2, "0");
  const s = Math.floor(tenths / 10);
  return `${Math.floor(s / 3600)}:${two(Math.floor(s / 60) % 60)}:${two(s % 60)}.${tenths % 10}`;
}

/**
 * What somebody typed as a whole number: spaces between thousands, a typographic minus and hexadecimal digits
 * are fine. `null` if it is none.
 */
export function parseWhole(text: string): number | null {
  const plain = text.replace(/[\s_\u2009]/g, "").replace("\u2212", "-");
  if (!/^[+-]?(\d+|0[xX][0-9a-fA-F]+)$/.test(plain)) return null;
  const sign = plain.startsWith("-") ? -1 : 1;
  const value = sign * Number(plain.replace(/^[+-]/, ""));
  return Number.isSafeInteger(value) ? value : null;
}

/** What somebody typed as a number with or without decimals. `null` if it is none. */
export function parseNumber(text: string): number | null {
  const plain = text.replace(/[\s_\u2009]/g, "").replace("\u2212", "-");
  return /^[+-]?(\d+\.?\d*|\.\d+)$/.test(plain) ? Number(plain) : parseWhole(text);
}
