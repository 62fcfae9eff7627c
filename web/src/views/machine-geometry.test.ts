import assert from "node:assert/strict";
import { test } from "node:test";
import type { MachineAxis } from "../api/contract.ts";
import { arc, around, covers, lane, touches } from "./machine-geometry.ts";

const stage: MachineAxis = {
  shaft: 0,
  negative_limit: -1000,
  positive_limit: 9000,
  home: [-200, 0],
  index_every: 400,
  circumference: null,
  load: 0,
  backlash: 0,
};
const round: MachineAxis = { ...stage, negative_limit: null, positive_limit: null, home: [100, 200], circumference: 2000 };

test("a rail goes from limit to limit, and pixels are pulses", () => {
  const rail = lane(stage, 1092);
  assert.equal(rail.x(-1000), 46);
  assert.equal(rail.x(9000), 1046);
  assert.equal(Math.round(rail.pulse(rail.x(1234))), 1234);
});

test("a rail reaches a shaft beyond its limits, and goes on where there are none", () => {
  assert.equal(lane({ ...stage, shaft: 12000 }, 1060).high, 12000);
  const open = lane({ ...stage, negative_limit: null, positive_limit: null, shaft: 52000 }, 1060);
  assert.ok(open.low <= 42000 && open.high >= 60000);
});

test("parts of a turn", () => {
  const check = (pulse: number, expected: number) => assert.equal(around(round, pulse), expected);
  check(0, 0);
  check(500, 0.25);
  check(-500, 0.75);
  check(4500, 0.25);
  assert.match(arc(round, [0, 500], 10), /^M 0\.00 -10\.00 A 10 10 0 0 1 10\.00 -?0\.00$/);
});

test("a switch at its place is pressed by the carriage alone", () => {
  const check = (axis: MachineAxis, expected: boolean[]) => {
    const pressed = (["negative limit", "home", "positive limit"] as const).map((role) => touches(axis, role));
    assert.deepEqual(pressed, expected, String(axis.shaft));
  };
  check({ ...stage, shaft: -1000 }, [true, false, false]);
  check({ ...stage, shaft: -200 }, [false, true, false]);
  check({ ...stage, shaft: 1 }, [false, false, false]);
  check({ ...stage, shaft: 9001 }, [false, false, true]);
  check({ ...round, shaft: 4150 }, [false, true, false]);
  check({ ...round, shaft: 1990 }, [false, false, false]);
  check({ ...round, home: [1990, 2010], shaft: 5 }, [false, true, false]);
  check({ ...round, home: [1990, 2010], shaft: 1000 }, [false, false, false]);
});

test("a switch that is dragged to the carriage is pressed", () => {
  const at = (shaft: number) => ({ ...stage, shaft });
  assert.equal(covers(at(0), "positive limit", 9000), false);
  assert.equal(covers(at(5000), "positive limit", 4000), true);
  assert.equal(covers(at(0), "negative limit", -1000), false);
  assert.equal(covers(at(0), "negative limit", 10), true);
  assert.equal(covers(at(3000), "home", 3090), true);
  assert.equal(covers(at(3000), "home", 3500), false);
  assert.equal(covers({ ...round, shaft: 1990 }, "home", 10), true);
  assert.equal(covers({ ...round, shaft: 1000 }, "home", 10), false);
});
