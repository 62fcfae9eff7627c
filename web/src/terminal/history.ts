// The lines typed before, as a shell has them.

/** Lines that are kept. */
export const MAX_LINES = 200;

export class History {
  #lines: string[];
  /** Place in the lines; their number while a new line is typed. */
  #at: number;
  #draft = "";

  constructor(lines: readonly string[] = []) {
    this.#lines = lines.slice(-MAX_LINES);
    this.#at = this.#lines.length;
  }

  get lines(): readonly string[] {
    return this.#lines;
  }

  /** A line was sent. The same one again is kept once. */
  add(line: string): void {
    if (line !== "" && line !== this.#lines.at(-1)) this.#lines = [...this.#lines, line].slice(-MAX_LINES);
    this.#at = this.#lines.length;
    this.#draft = "";
  }

  /** The line before, given what is typed now; null at the oldest. */
  older(typed: string): string | null {
    if (this.#at === 0) return null;
    if (this.#at === this.#lines.length) this.#draft = typed;
    this.#at -= 1;
    return this.#lines[this.#at] ?? null;
  }

  /** The line after, at last what was typed; null there. */
  newer(): string | null {
    if (this.#at === this.#lines.length) return null;
    this.#at += 1;
    return this.#lines[this.#at] ?? this.#draft;
  }
}
