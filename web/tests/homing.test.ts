// Homing by every mode of every catalog, in small machines whose clocks run a hundred times as fast.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import type { Catalog, Machine, Status } from "../src/api/contract.ts";
import { Server, look, number, until, withBrowser } from "./bench.ts";

const [LIMIT, MARKS, HOME] = [2000, 400, [-200, 300] as const];
const machine = (more = "") => `negative_limit = -${LIMIT}
positive_limit = ${LIMIT}
home = [${HOME.join(", ")}]
index_every = ${MARKS}
${more}
`;
const BENCH = `
[[device]]
model = "pd42-1140"
listen = ["tcp:127.0.0.1:0"]
[device.axis.0]
${machine()}
[[device]]
model = "pd42-1140"
name = "inverted"
listen = ["tcp:127.0.0.1:0"]
[device.axis.0]
${machine('normally_closed = ["home"]')}
[[device]]
model = "pmx-2ed"
listen = ["tcp:127.0.0.1:0"]
[device.axis.X]
${machine()}
[[device]]
model = "cmd-4cr"
listen = ["tcp:127.0.0.1:0"]
[device.axis.X]
${machine()}
`;

withBrowser();
let server: Server;
before(async () => {
  server = await Server.start({ bench: BENCH, speed: 100 });
});
after(() => server.stop());

/** Where zero is in the machine, and on which side of it the motor comes to rest, seen in the direction of the search. */
interface End {
  zero: (direction: 1 | -1) => number;
  rest: -1 | 0 | 1;
}
const at = (zero: End["zero"], rest: End["rest"] = 0): End => ({ zero, rest });

/** From where each search begins: a thousand pulses before 0. */
const START = -1000;
const edge = (direction: 1 | -1) => (direction > 0 ? HOME[0] : HOME[1]);
const middle = () => (HOME[0] + HOME[1]) / 2;
const limit = (direction: 1 | -1) => direction * LIMIT;
const mark = () => 0;
const markBefore = (direction: 1 | -1) => -direction * MARKS;
const markAtLimit = (direction: 1 | -1) => direction * (LIMIT - MARKS);

/** Chapter 7.1 of the manual of the PD42-1140. */
const TRINAMIC: Record<number, End> = {
  1: at(limit),
  2: at(limit),
  3: at(limit),
  4: at(limit),
  5: at(middle),
  6: at(middle),
  7: at(middle),
  8: at(middle),
};
const INVERTED: Record<number, End> = { 133: at(middle), 134: at(middle), 135: at(middle), 136: at(middle) };
/** Chapter 7.10 of the manual of the PMX-2ED-SA; LCA is 1,000 as delivered. */
const PERFORMAX: Record<number, End> = {
  0: at(edge, 1),
  1: at((direction) => direction * (LIMIT - 1000)),
  2: at(mark),
  3: at((direction) => -direction * 2 * MARKS),
  4: at(edge),
};
/** Appendix A of the manual of the CMD-4CR. */
const COMMANDER: Record<number, End> = {
  0: at(edge, 1),
  1: at(edge),
  2: at(mark),
  3: at(mark, 1),
  4: at(markBefore),
  5: at(markBefore, -1),
  6: at((direction) => direction * (LIMIT - 1)),
  7: at(markAtLimit),
  8: at(markAtLimit, -1),
  9: at(edge),
  10: at(mark),
  11: at(markBefore),
  12: at(markAtLimit),
};

const DEVICES = [
  ["pd42-1140", "pd42-1140", TRINAMIC],
  ["inverted", "pd42-1140", INVERTED],
  ["pmx-2ed", "pmx-2ed", PERFORMAX],
  ["cmd-4cr", "cmd-4cr", COMMANDER],
] as const;

test("each controller homes by each of its modes, and zero is where the manual says", async () => {
  const seen = new Map<string, Set<number>>();
  for (const [device, model, ends] of DEVICES) {
    const { axes, homing, actions } = await server.ask<Catalog>("GET", `/models/${model}`);
    const axis = axes[0]!;
    const act = (action: object) => server.ask("POST", `/devices/${device}/act`, action);
    const shaft = async () => (await server.ask<Machine>("GET", `/devices/${device}/machine`)).axes[axis]!.shaft;
    const status = async () => (await server.ask<Status>("GET", `/devices/${device}/status`)).axes[axis]!;
    if (actions.includes("power")) await act({ do: "power", axis, on: true });
    await look(server, `#/${device}/control`, async (page) => {
      const panel = page.getByRole("region", { name: "Home", exact: true });
      const shown = page.getByRole("region", { name: `Axis ${axis}`, exact: true });
      for (const mode of homing.filter(({ id }) => id in ends)) {
        seen.set(model, (seen.get(model) ?? new Set()).add(mode.id));
        const { zero, rest } = ends[mode.id]!;
        await panel.getByLabel("Mode").selectOption(String(mode.id));
        for (const sign of mode.directions) {
          const direction = sign === "+" ? 1 : -1;
          // By hand, so that the counter does not know.
          const away = direction * START - (await shaft());
          if (away !== 0) await server.ask("POST", `/devices/${device}/axes/${axis}/push`, away);
          const ended = `${device}, mode ${mode.id}${sign}`;
          const word = direction > 0 ? "positive" : "negative";
          await panel.getByRole("button", { name: `Home ${axis} in ${word} direction` }).click();
          const there = async () => {
            const { position, state, speed, error } = await status();
            return { zero: (await shaft()) - position, position, state, speed, error };
          };
          const end = await until(ended, there, (now) =>
            // Half a pulse beside: the middle between the two sides of a limit switch.
            Math.abs(now.zero - zero(direction)) <= 1 && now.state === "idle" && now.speed === 0 && now.error === null &&
            Math.sign(now.position) === rest * direction);
          await until(`${ended}, shown`, () => number(shown.locator("[data-role=position]")), (at) => at === end.position);
          await until(`${ended}, state`, () => shown.locator("[data-role=state]").innerText(), (text) => text === "idle");
        }
      }
      assert.equal(await shown.getByText("no error").count(), 1);
    });
  }
  for (const [, model] of DEVICES) {
    const { homing } = await server.ask<Catalog>("GET", `/models/${model}`);
    assert.deepEqual([...seen.get(model)!].sort((a, b) => a - b), homing.map(({ id }) => id).sort((a, b) => a - b));
  }
});
