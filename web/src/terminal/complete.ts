// Which commands a half-typed line could become, and which one a whole line is.

import type { CommandInfo } from "../api/contract.ts";

/** Proposals that are shown. */
export const MAX_PROPOSALS = 12;

/** What a line begins with: a name of the table is letters, or none at all (a move: `X1000`). */
function head(line: string): string {
  return /^\s*([A-Za-z]*)/.exec(line)?.[1] ?? "";
}

/** Commands of which the line is the beginning, each name once, those of the same letters in any case. */
export function proposals(commands: readonly CommandInfo[], line: string): CommandInfo[] {
  const typed = head(line).toUpperCase();
  if (typed === "" || line.trim() !== head(line)) return [];
  const seen = new Set<string>();
  const found = commands.filter(({ name, syntax }) => {
    const fits = name.toUpperCase().startsWith(typed) && !seen.has(syntax);
    if (fits) seen.add(syntax);
    return fits;
  });
  found.sort((a, b) => a.name.length - b.name.length || a.name.localeCompare(b.name));
  return found.slice(0, MAX_PROPOSALS);
}

/** The commands that a line is about: those with the longest name that it begins with. */
export function about(commands: readonly CommandInfo[], line: string): CommandInfo[] {
  const typed = head(line).toUpperCase();
  if (typed === "") return [];
  const fitting = commands.filter(({ name }) => name !== "" && typed.startsWith(name.toUpperCase()));
  const longest = Math.max(0, ...fitting.map(({ name }) => name.length));
  return fitting.filter(({ name }) => name.length === longest);
}
