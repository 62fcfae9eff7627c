// A pin whose value follows a hand: not every movement goes to the server, but the last one does.

import type { Api } from "../api/client.ts";
import { attempt } from "../ui/toast.ts";

/** Between two values that are sent. */
const PAUSE_MS = 60;

export class Slide {
  readonly #api: Api;
  readonly #device: string;
  readonly #pin: string;
  #wanted: number | null = null;
  #busy = false;

  constructor(api: Api, device: string, pin: string) {
    this.#api = api;
    this.#device = device;
    this.#pin = pin;
  }

  /** Drives the pin; `null` gives it back to the machine. */
  set(value: number | null): void {
    this.#wanted = value;
    if (!this.#busy) void this.#send();
  }

  /** One request at a time, so that none overtakes another. */
  async #send(): Promise<void> {
    this.#busy = true;
    let sent: number | null | undefined;
    while (sent !== this.#wanted) {
      sent = this.#wanted;
      const value = sent;
      const well = await attempt(() =>
        value === null
          ? this.#api.releasePin(this.#device, this.#pin)
          : this.#api.drivePin(this.#device, this.#pin, value),
      );
      if (!well) break;
      await new Promise((resolve) => window.setTimeout(resolve, PAUSE_MS));
    }
    this.#busy = false;
  }
}
