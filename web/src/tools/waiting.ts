// Waiting until an axis rests.

import type { Api } from "../api/client.ts";
import type { AxisStatus } from "../api/contract.ts";

const LOOK_MS = 80;
/** It rests if it stood where it stands that often. */
const STILL = 3;
/** Moves that take longer are given up. */
const LONGEST_MS = 120_000;

/**
 * The status of an axis once it rests, or at once when `cancelled`.
 *
 * Fails if the axis does not come to rest, or cannot be asked.
 */
export async function settled(
  api: Api,
  device: string,
  axis: string,
  cancelled: () => boolean,
): Promise<AxisStatus> {
  const end = performance.now() + LONGEST_MS;
  let still = 0;
  let before: AxisStatus | undefined;
  for (;;) {
    const status = (await api.status(device)).axes[axis];
    if (status === undefined) throw new Error(`There is no axis ${axis}.`);
    const rests = status.speed === 0 && status.position === before?.position && status.encoder === before.encoder;
    still = rests ? still + 1 : 0;
    if (still >= STILL || cancelled()) return status;
    if (performance.now() > end) throw new Error(`Axis ${axis} does not come to rest.`);
    before = status;
    await new Promise((resolve) => window.setTimeout(resolve, LOOK_MS));
  }
}
