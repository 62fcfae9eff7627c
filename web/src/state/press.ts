// An input that is the other way round while the page holds it: a switch that opens when it is pressed needs no special
// care, and one that the machine presses is let go. Requests go out one after the other.

import type { Api } from "../api/client.ts";
import { attempt } from "../ui/toast.ts";

export class Press {
  readonly #api: Api;
  readonly #device: string;
  readonly #pin: string;
  #pressed = false;
  #queue: Promise<unknown> = Promise.resolve();

  constructor(api: Api, device: string, pin: string) {
    this.#api = api;
    this.#device = device;
    this.#pin = pin;
  }

  /** Whether it is pressed. */
  get pressed(): boolean {
    return this.#pressed;
  }

  set(pressed: boolean): void {
    if (pressed === this.#pressed) return;
    this.#pressed = pressed;
    this.#queue = this.#queue.then(() => attempt(() => (pressed ? this.#press() : this.#release())));
  }

  async #press(): Promise<void> {
    const level = await this.#api.pin(this.#device, this.#pin);
    await this.#api.drivePin(this.#device, this.#pin, level === false || level === 0);
  }

  #release(): Promise<void> {
    return this.#api.releasePin(this.#device, this.#pin);
  }
}
