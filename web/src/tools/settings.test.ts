import assert from "node:assert/strict";
import { test } from "node:test";
import type { Catalog, Role } from "../api/contract.ts";
import { profile } from "./profile.ts";
import { counting, deciding, microsteps, plan, type Values } from "./settings.ts";

const ROLES: Record<string, Role> = {
  HSPD: "high_speed", LSPD: "low_speed", ACC: "acceleration", DEC: "deceleration", EDEC: "own_deceleration",
  SCV: "s_curve", SL: "closed_loop", SLR: "closed_loop_ratio",
};
const model = (language: Catalog["language"], ids: string[] = []) => {
  const parameters = ids.map((id) => {
    const axis = id.endsWith("X") ? "X" : null;
    return { id, axis, role: ROLES[axis === null ? id : id.slice(0, -1)] ?? null };
  });
  return { language, speed_windows: [], parameters } as unknown as Catalog;
};
const TMCL = model("tmcl");
const SETTINGS = ["HSPD", "LSPD", "ACC", "DEC", "HSPDX", "LSPDX", "ACCX", "DECX", "SCVX", "SLX", "SLRX"];
const ASCII = model("a-script", SETTINGS);
const WITH_EDEC = model("a-script", [...SETTINGS, "EDEC"]);

const MODULE = { "AP4.0": 1000, "AP5.0": 500, "AP130.0": 1, "AP138.0": 0, "AP140.0": 8, "AP153.0": 3, "AP154.0": 2 };
const STAGE = { HSPD: 1000, LSPD: 100, ACC: 300, DEC: 200, HSPDX: 0, LSPDX: 0, ACCX: 0, DECX: 0, SCVX: 0, SLX: 0, SLRX: 2.5 };

test("the module's factory settings: 61,035 pps, reached with 7.45 million pps² (6.1)", () => {
  const { move, notes } = plan(TMCL, "0", MODULE, 51_200);
  assert.equal(Math.round(move.topPps), 61_035);
  assert.equal(Math.round(move.acceleration), 7_450_581);
  assert.equal(move.startPps, move.topPps / 1000);
  assert.deepEqual(notes, []);
  assert.equal(microsteps(TMCL, "0", MODULE), 256);
  assert.deepEqual(counting(TMCL, "0", MODULE), { divisors: { pulse: 2, ramp: 3 } });
});

test("what the module cannot do, or does otherwise, is said", () => {
  assert.match(plan(TMCL, "0", { ...MODULE, "AP153.0": 0, "AP5.0": 2000 }, 1).notes.join(), /from 1 to 1023/);
  assert.match(plan(TMCL, "0", { ...MODULE, "AP138.0": 1 }, 1).notes.join(), /soft approach/);
});

function check(values: Values, top: number, acceleration: number, deceleration: number, catalog = ASCII) {
  const { move } = plan(catalog, "X", values, 100_000);
  const shown = [move.topPps, move.acceleration, move.deceleration].map(Math.round);
  assert.deepEqual(shown, [top, acceleration, deceleration]);
}

test("an axis' own settings come before those of all", () => {
  check(STAGE, 1000, 3000, 4500);
  check({ ...STAGE, HSPDX: 2000, ACCX: 500 }, 2000, 3800, 9500);
});

test("without a deceleration of its own it is the acceleration (PMX-2ED-SA, 7.1)", () => {
  check({ ...STAGE, EDEC: 0 }, 1000, 3000, 3000, WITH_EDEC);
  check({ ...STAGE, EDEC: 1 }, 1000, 3000, 4500, WITH_EDEC);
});

test("in a closed loop speeds and ways are encoder counts", () => {
  const { move } = plan(ASCII, "X", { ...STAGE, SLX: 1 }, 400);
  assert.deepEqual([move.pulses, move.topPps], [1000, 2500]);
  assert.deepEqual(counting(ASCII, "X", STAGE), { pulsesPerCount: 2.5 });
  assert.equal(microsteps(ASCII, "X", STAGE), null);
});

test("only what a model has", () => {
  const catalog = model("a-script", ["HSPDX", "HSPD", "EDEC", "V1"]);
  assert.deepEqual(deciding(catalog, "X").map(({ id }) => id), ["HSPDX", "HSPD", "EDEC"]);
});

test("moves take as long as on the virtual controllers", () => {
  // Seconds from the first line of a program to its end, of which its lines themselves take 0.6 ms.
  const check = (catalog: Catalog, axis: string, values: Values, way: number, seconds: number) => {
    const planned = profile(plan(catalog, axis, values, way).move).seconds;
    assert.ok(Math.abs(seconds - planned) < 0.001, `${planned} s, ${seconds} s measured`);
  };
  const fast = { HSPD: 20_000, LSPD: 1000, ACC: 900, DEC: 300, EDEC: 0 };
  check(WITH_EDEC, "X", { HSPD: 5000, LSPD: 100, ACC: 300, DEC: 300, EDEC: 0 }, 10_000, 2.2946);
  check(WITH_EDEC, "X", fast, 3000, 0.66573);
  check(WITH_EDEC, "X", { ...fast, SCVX: 1 }, 30_000, 2.3557);
  check(WITH_EDEC, "X", { ...fast, SCVX: 1 }, 3000, 0.89615);
  check(TMCL, "0", MODULE, 51_200, 0.84714);
  check(TMCL, "0", { ...MODULE, "AP153.0": 7, "AP5.0": 50 }, 12_000, 1.01276);
});
