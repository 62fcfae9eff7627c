// The live chart.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { Server, look, picture, until, withBrowser } from "./bench.ts";

withBrowser();
let server: Server;
before(async () => {
  server = await Server.start();
});
after(() => server.stop());

test("eight curves of a move, paused, zoomed and saved", async () => {
  await look(server, "#/cmd-4cr/chart", async (page) => {
    const curves = page.locator("pt-curves");
    for (const axis of ["X", "Y", "Z", "U"]) {
      await server.ask("POST", "/devices/cmd-4cr/act", { do: "power", axis, on: true });
    }
    await server.ask("POST", "/devices/cmd-4cr/act", { do: "jog", axis: "X", direction: 1 });
    await server.ask("POST", "/devices/cmd-4cr/act", { do: "move", targets: { Y: 900, Z: -700 }, relative: false });
    const picked = curves.getByRole("group").getByRole("button", { pressed: true });
    await until("eight curves", () => picked.count(), (count) => count === 8);
    await page.getByLabel("Time shown").selectOption("5");
    await until("frames are counted", () => curves.getAttribute("data-fps"), (fps) => fps !== null);
    await page.waitForTimeout(3500);
    console.log(`# ${await curves.getAttribute("data-fps")} frames a second with eight curves`);
    await picture(page, "chart", "dark");
    await page.getByLabel("Time shown").selectOption("60");
    await page.waitForTimeout(1500);
    console.log(`# ${await curves.getAttribute("data-fps")} frames a second with eight curves over a minute`);

    await curves.getByRole("button", { name: "Pause" }).click();
    await curves.getByText("Paused.").waitFor();
    const plot = await curves.locator(".u-over").boundingBox();
    assert.ok(plot);
    const ticks = () => curves.locator("canvas").evaluate((canvas) => (canvas as HTMLCanvasElement).toDataURL());
    const whole = await ticks();
    await page.mouse.move(plot.x + plot.width * 0.8, plot.y + 50);
    await page.mouse.down();
    await page.mouse.move(plot.x + plot.width * 0.95, plot.y + 50, { steps: 5 });
    await page.mouse.up();
    await until("zoomed", ticks, (now) => now !== whole);

    const save = async (name: string) => {
      const download = page.waitForEvent("download");
      await curves.getByRole("button", { name }).click();
      return readFile(await (await download).path());
    };
    const csv = (await save("CSV")).toString().split("\n");
    assert.equal(csv[0], "seconds,X position,Y position,Z position,U position,X speed,Y speed,Z speed,U speed");
    const rows = csv.slice(1, -1).map((line) => line.split(",").map(Number));
    assert.ok(rows.length > 100, `${rows.length} rows`);
    const step = rows[50]![0]! - rows[49]![0]!;
    assert.ok(Math.abs(step - 0.01) < 1e-6, `a sample every ${step} s`);
    assert.ok(rows.at(-1)![1]! > rows[0]![1]!);
    assert.deepEqual([...(await save("PNG")).subarray(1, 4)], [..."PNG"].map((letter) => letter.charCodeAt(0)));
    await server.ask("POST", "/devices/cmd-4cr/stop");
  });
});
