// What went over the wire: which of it is shown, and as a file.

import type { Traffic } from "../api/contract.ts";

/** What is to be seen of the traffic. */
export interface Filter {
  /** Words between spaces: each must be in the text or, as hex digits, in the bytes. `-word` must not. */
  words: string;
  direction: "both" | "out" | "in";
  /** Whether what is asked over and over, to see what the controller does, is shown too. */
  polled: boolean;
}

/** The traffic that a filter lets through. */
export function filtered(traffic: readonly Traffic[], { words, direction, polled }: Filter): Traffic[] {
  const tests = words.toLowerCase().split(/\s+/).filter((word) => word !== "" && word !== "-");
  return traffic.filter((line) => {
    if (line.polled && !polled) return false;
    if (direction !== "both" && line.out !== (direction === "out")) return false;
    return tests.every((word) => (word.startsWith("-") ? !has(line, word.slice(1)) : has(line, word)));
  });
}

function has(line: Traffic, word: string): boolean {
  if (line.text.toLowerCase().includes(word)) return true;
  return /^([0-9a-f]{2})+$/.test(word) && inBytes(line.hex, word);
}

/** Whether hex digits stand in the bytes, beginning at a byte. */
function inBytes(bytes: string, digits: string): boolean {
  const plain = bytes.replace(/\s/g, "").toLowerCase();
  for (let at = plain.indexOf(digits); at >= 0; at = plain.indexOf(digits, at + 1)) {
    if (at % 2 === 0) return true;
  }
  return false;
}

/** The traffic as a table of comma-separated values. */
export function csv(traffic: readonly Traffic[]): string {
  const quote = (text: string) => `"${text.replaceAll('"', '""')}"`;
  const rows = traffic.map(({ at, out, hex, text }) => [at.toFixed(6), out ? "out" : "in", hex, quote(text)].join(","));
  return ["seconds,direction,hex,text", ...rows, ""].join("\r\n");
}
