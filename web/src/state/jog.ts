// A jog that lasts as long as a button is held, and no longer than this page is heard of.

import type { Api } from "../api/client.ts";
import { attempt } from "../ui/toast.ts";
import type { LiveStore } from "./live.ts";

export class Jog {
  readonly #api: Api;
  readonly #live: LiveStore;
  readonly #axis: string;
  /** What the server has not answered yet. */
  #begun: Promise<unknown> | null = null;

  constructor(api: Api, live: LiveStore, axis: string) {
    this.#api = api;
    this.#live = live;
    this.#axis = axis;
  }

  begin(direction: 1 | -1): void {
    const [device, axis] = [this.#live.name, this.#axis];
    const begun = attempt(() => this.#api.act(device, { do: "jog", axis, direction, held: true }));
    this.#begun = begun.finally(() => {
      this.#begun = null;
    });
    this.#live.hold(axis);
  }

  /**
   * Stops at once, and once more if the jog was still on its way: it may arrive later than the stop. If the axis cannot
   * be stopped alone, as when control was lost meanwhile, everything is stopped.
   */
  end(): void {
    const [device, axis] = [this.#live.name, this.#axis];
    const stop = () => attempt(() => this.#api.act(device, { do: "stop", axis }).catch(() => this.#api.stop(device)));
    const late = this.#begun;
    this.#live.letGo(axis);
    void stop();
    if (late) void late.then(stop);
  }
}
