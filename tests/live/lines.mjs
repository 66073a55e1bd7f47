// Tests of what is under the cursor, and of lines of sight.
import assert from "node:assert/strict";
import { test } from "node:test";

import {
  boxOf,
  changed,
  closed,
  counted,
  mastAt,
  middleOf,
  observer,
  pageWithMast,
  setField,
  settled,
  stillPicture,
  text,
  until,
  MIDDLE,
} from "./planner.mjs";
import { itin, keepPicture, world } from "./served_map.mjs";

/** The document of `itin los` from the mast to what the page's address has as target. */
function lineTo(mast, page) {
  const target = new URLSearchParams(new URL(page.url()).hash.slice(1)).get("target");
  return JSON.parse(itin(`los hills.itin --from ${observer(mast)} --to ${target},2 --json`, world.folder));
}

test("the readout says what is under the cursor, and a click shows the line of sight", async () => {
  const page = await pageWithMast();
  const mast = await mastAt(page);
  const words = { visible: /: visible/, hidden: /: hidden/, undecided: /: undecided/ };
  await page.mouse.move(MIDDLE.x + 90, MIDDLE.y - 60, { steps: 3 });
  await page.waitForSelector("#readout", { visible: true });
  await page.waitForFunction(() => document.querySelector("#readout dl")?.textContent.includes("true"));
  const readout = await text(page, "#readout");

  await page.mouse.click(MIDDLE.x + 90, MIDDLE.y - 60);
  await page.waitForSelector("#line:not([hidden])");
  await page.waitForSelector("#line[aria-busy=false]");
  await page.waitForFunction(() => location.hash.includes("&target="));
  const line = lineTo(mast, page);
  assert.match(await text(page, ".readout-verdict"), words[line.verdict]);
  assert.match(readout, new RegExp(`Distance${(line.distance_m / 1000).toFixed(2).replace(".", "\\.")} km`));
  const [grid, north] = [line.from.azimuth_grid_deg, line.from.azimuth_true_deg].map((azimuth) =>
    azimuth.toFixed(1).padStart(5, "0"),
  );
  assert.ok(readout.includes(`Azimuth${grid}° grid, ${north}° true`), readout);
  assert.match(await text(page, "#line-verdict"), line.verdict === "visible" ? /in sight/ : /hidden by/);
  await keepPicture(page, "line");

  // It is a matter of masts.
  await page.$eval("#tasks input[value=turbines]", (input) => input.click());
  await page.waitForSelector("#line[hidden]");
  assert.equal(await page.$(".target").then((target) => target.isVisible()), false);
  await closed(page);
});

test("hovering ties the profile and the map", async () => {
  const page = await pageWithMast();
  await page.mouse.click(MIDDLE.x + 200, MIDDLE.y);
  await page.waitForSelector("#profile canvas");
  await page.mouse.move(MIDDLE.x + 200, MIDDLE.y + 90); // away from the line
  const marker = await middleOf(page, ".marker");
  const middle = { x: marker.x + 100, y: marker.y };
  const around = { clip: { x: middle.x - 12, y: middle.y - 12, width: 24, height: 24 } };
  const without = await stillPicture(page, around);
  const plot = await boxOf(page, ".u-over");
  await page.mouse.move(plot.x + plot.width / 2, plot.y + plot.height / 2, { steps: 2 });
  await changed(page, without, around, "the map marks the place");
  await page.mouse.move(middle.x, middle.y + 3, { steps: 2 });
  await until(
    async () => Math.abs((await boxOf(page, ".u-cursor-x")).x - plot.x - plot.width / 2) < 0.03 * plot.width,
    "the profile's cursor follows",
  );
  await page.keyboard.press("Escape");
  await page.waitForSelector("#line[hidden]");
  await closed(page);
});

test("a line goes from mast to mast, and follows both", async () => {
  const page = await pageWithMast();
  const first = await mastAt(page);
  await page.mouse.click(MIDDLE.x + 60, MIDDLE.y + 40, { button: "right" });
  await settled(page);
  const second = await mastAt(page);
  await page.select(".mast.selected select", "0");
  await page.waitForSelector("#line[aria-busy=false]:not([hidden])");
  const line = JSON.parse(
    itin(`los hills.itin --from ${observer(second)} --to ${observer(first)} --json`, world.folder),
  );
  assert.match(await text(page, "#line-verdict"), line.verdict === "visible" ? /^Mast B to Mast A: in/ : /: hidden by/);
  assert.ok((await text(page, "#line-facts")).includes(`${(line.distance_m / 1000).toFixed(2)} km`));
  await page.waitForFunction(() => location.hash.includes("&target=mast:0"));
  await closed(page);
});

test("with a frequency the Fresnel zone counts, on the map and along the line", async () => {
  const page = await pageWithMast();
  await setField(page, "[name=frequency]", "5.8");
  await settled(page);
  const cells = counted(observer(await mastAt(page)), " --frequency 5.8");
  const share = (100 * cells.visible) / (cells.visible + cells.hidden + cells.undecided + cells.zone_cut);
  assert.ok((await text(page, ".mast-summary")).endsWith(` ${share.toFixed(1)} %`));
  assert.match(await text(page, "#legend-list"), /paler: Fresnel zone cut/);
  await page.mouse.click(MIDDLE.x + 90, MIDDLE.y - 60);
  await page.waitForSelector("#line[aria-busy=false]");
  assert.match(await text(page, "#line-facts"), /least clearance .* F1.*dB free space/);
  await keepPicture(page, "fresnel");
  await closed(page);
});
