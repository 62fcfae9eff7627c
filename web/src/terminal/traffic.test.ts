import assert from "node:assert/strict";
import { test } from "node:test";
import { csv, filtered, type Filter } from "./traffic.ts";

const TRAFFIC = [
  { at: 0.5, out: true, hex: "01 06 01 00 00 00 00 00 08", text: "GAP 1, 0", polled: true },
  { at: 0.501, out: false, hex: "02 01 64 06 00 00 00 10 7D", text: 'ok, 16 "µsteps"', polled: true },
];

function check(filter: Partial<Filter>, expected: number[]) {
  const shown = filtered(TRAFFIC, { words: "", direction: "both", polled: true, ...filter });
  assert.deepEqual(shown.map((line) => TRAFFIC.indexOf(line)), expected, JSON.stringify(filter));
}

test("words, bytes and directions", () => {
  check({}, [0, 1]);
  check({ polled: false }, []);
  check({ words: "gap" }, [0]);
  check({ words: "02 64" }, [1]);
  check({ words: "-gap -" }, [1]);
  check({ words: "6406" }, [1]);
  // Half of two bytes is no byte.
  check({ words: "40" }, []);
  check({ words: "640" }, []);
  check({ direction: "in" }, [1]);
  check({ direction: "out", words: "64" }, []);
});

test("as a table", () => {
  assert.equal(
    csv(TRAFFIC),
    "seconds,direction,hex,text\r\n" +
      '0.500000,out,01 06 01 00 00 00 00 00 08,"GAP 1, 0"\r\n' +
      '0.501000,in,02 01 64 06 00 00 00 10 7D,"ok, 16 ""µsteps"""\r\n',
  );
});
