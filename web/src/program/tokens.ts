// Semantic tokens of the language server: five numbers each, relative to the one before. (Language Server Protocol
// 3.17, "Semantic Tokens".)

/** What the numbers mean: the server's own lists. */
export interface Legend {
  tokenTypes: readonly string[];
  tokenModifiers: readonly string[];
}

/** A coloured stretch of a line. */
export interface Token {
  /** From 0. */
  line: number;
  /** UTF-16 units, as in an editor's line. */
  start: number;
  length: number;
  /** `cm-token-TYPE` and a class for each modifier. */
  classes: string;
}

/** Numbers of a token. */
const WIDTH = 5;

/** Decodes a full answer. What does not fit the legend, or is cut off, is left out. */
export function decode(data: readonly number[], legend: Legend): Token[] {
  const tokens: Token[] = [];
  let line = 0;
  let start = 0;
  for (let n = 0; n + WIDTH <= data.length; n += WIDTH) {
    const [lines = 0, columns = 0, length = 0, type = 0, modifiers = 0] = data.slice(n, n + WIDTH);
    line += lines;
    start = lines === 0 ? start + columns : columns;
    const name = legend.tokenTypes[type];
    if (name === undefined || length <= 0) continue;
    const set = legend.tokenModifiers.filter((_, bit) => (modifiers >> bit) & 1);
    tokens.push({ line, start, length, classes: [name, ...set].map((word) => `cm-token-${word}`).join(" ") });
  }
  return tokens;
}
