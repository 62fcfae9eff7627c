// The newest samples of a device in typed arrays, ready to draw without copying.

import type { Samples } from "../api/contract.ts";

/** What a curve can show of an axis. */
export const QUANTITIES = ["position", "speed", "encoder", "delta", "load"] as const;
export type Quantity = (typeof QUANTITIES)[number];

/** Samples kept: 65 s at 100 a second, so that a window of 60 s is always full. */
export const CAPACITY = 6500;

/**
 * A ring whose newest values are always one piece of memory: each value is written twice, a capacity apart.
 */
class Column {
  readonly #values = new Float64Array(2 * CAPACITY);

  put(at: number, value: number): void {
    this.#values[at] = value;
    this.#values[at + CAPACITY] = value;
  }

  view(start: number, length: number): Float64Array {
    return this.#values.subarray(start, start + length);
  }
}

export class SampleRing {
  readonly #time = new Column();
  readonly #columns = new Map<string, Column>();
  #next = 0;
  #length = 0;
  #last = Number.NEGATIVE_INFINITY;
  /** Grows with each batch, so that a drawing knows whether anything is new. */
  version = 0;

  /** How many samples there are. */
  get length(): number {
    return this.#length;
  }

  /** The device's time of the newest sample, in seconds. */
  get last(): number {
    return this.#last;
  }

  /** Whether a quantity has ever had a value. */
  has(axis: string, quantity: Quantity): boolean {
    return this.#columns.has(`${axis} ${quantity}`);
  }

  add(samples: Samples): void {
    const axes = Object.entries(samples.axes);
    samples.seconds.forEach((seconds, n) => {
      // A device that was switched off and on begins its time anew.
      if (seconds <= this.#last) {
        if (this.#last - seconds < 0.5) return;
        this.clear();
      }
      this.#time.put(this.#next, seconds);
      for (const [axis, values] of axes) {
        for (const quantity of QUANTITIES) {
          const value = values[quantity]?.[n];
          if (value !== undefined && value !== null) this.#column(axis, quantity).put(this.#next, value);
        }
      }
      this.#last = seconds;
      this.#next = (this.#next + 1) % CAPACITY;
      this.#length = Math.min(this.#length + 1, CAPACITY);
    });
    this.version += 1;
  }

  clear(): void {
    this.#next = 0;
    this.#length = 0;
    this.#last = Number.NEGATIVE_INFINITY;
    this.version += 1;
  }

  /** The times, oldest first: a view that the next `add` may change. */
  time(): Float64Array {
    return this.#time.view(this.#start(), this.#length);
  }

  /** The values of a curve beside `time`. */
  values(axis: string, quantity: Quantity): Float64Array {
    return this.#column(axis, quantity).view(this.#start(), this.#length);
  }

  #column(axis: string, quantity: Quantity): Column {
    const name = `${axis} ${quantity}`;
    let column = this.#columns.get(name);
    if (!column) {
      column = new Column();
      this.#columns.set(name, column);
    }
    return column;
  }

  #start(): number {
    return (this.#next - this.#length + CAPACITY) % CAPACITY;
  }
}
