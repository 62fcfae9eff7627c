// Between lines of a source and addresses of the compiled program.

/** Pairs of address and line (from 1), as the compiler gives them. */
export type Lines = readonly (readonly [number, number])[];

/** The line whose code an address is in; null outside of the program. */
export function lineAt(lines: Lines, address: number): number | null {
  let found: number | null = null;
  let nearest = -1;
  for (const [start, line] of lines) {
    if (start <= address && start > nearest) [nearest, found] = [start, line];
  }
  return found;
}

/** The first address of a line's code; null if it has none. */
export function addressOf(lines: Lines, line: number): number | null {
  const addresses = lines.filter(([, other]) => other === line).map(([address]) => address);
  return addresses.length === 0 ? null : Math.min(...addresses);
}

/** The line itself, or the next one that has code, where a breakpoint can stand; null after the last. */
export function breakable(lines: Lines, line: number): number | null {
  const later = lines.map(([, other]) => other).filter((other) => other >= line);
  return later.length === 0 ? null : Math.min(...later);
}
