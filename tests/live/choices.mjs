// Tests of what the page offers and says: the ground before anything stands on it, undecided ground, messages, boxes.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

import { axeFindings, closed, pageWithMast, setField, settled, text, until, MIDDLE } from "./planner.mjs";
import { module } from "./page_modules.mjs";
import { itin, keepPicture, openPage, serve, world } from "./served_map.mjs";

test("before the first mast stands the readout tells the ground, the place and its grid reference", async () => {
  const page = await openPage(world.browser, world.hills.address);
  await page.mouse.move(MIDDLE.x, MIDDLE.y, { steps: 2 });
  await page.waitForSelector("#readout", { visible: true });
  const readout = await until(async () => {
    const said = await text(page, "#readout");
    return /EPSG:27700/.test(said) && said;
  }, "the place is told");
  const [, ground, east, north] = readout.match(/^Ground ([\d.]+) mAt(\d+\s\d+) E (\d+\s\d+) N/);
  const [x, y] = [east, north].map((number) => Number(number.replace(/\s/, "")));
  const at = `${x},${y}`;
  const { from } = JSON.parse(itin(`los hills.itin --from ${at},0 --to ${at},0 --json`, world.folder));
  assert.ok(Math.abs(from.ground_m - Number(ground)) < 2, `${from.ground_m}: ${readout}`);
  const latitude = Number(readout.match(/([\d.]+)N/)[1]);
  assert.ok(Math.abs(from.lat - latitude) < 2e-5, `${from.lat}: ${readout}`);
  const reference = readout.match(/Grid referenceS[TO] (\d{5}) (\d{5})/);
  for (const [part, i] of [x, y].map((metres, axis) => [metres % 100000, axis + 1])) {
    assert.ok(Math.abs(Number(reference[i]) - part) <= 1, readout);
  }
  await keepPicture(page, "ground");

  // Beside the data there is nothing to tell.
  await page.mouse.move(310, 780, { steps: 2 });
  await page.waitForFunction(() => document.querySelector("#readout").hidden);
  await page.mouse.move(MIDDLE.x, MIDDLE.y, { steps: 2 });
  await page.mouse.click(MIDDLE.x, MIDDLE.y);
  await settled(page);
  await page.mouse.move(MIDDLE.x + 60, MIDDLE.y, { steps: 2 });
  await until(async () => /^Mast A: /.test(await text(page, "#readout")), "with a mast, what that sees");
  await closed(page);
});

/** A plain with a ridge, and a small void behind it. */
function writePlainWithVoid(folder) {
  const side = 120;
  const rows = Array.from({ length: side }, (_, j) =>
    Array.from({ length: side }, (__, i) =>
      i > 58 && i < 62 && j > 50 && j < 60 ? -9999 : 20 + (i * 0.1 + Math.sin(j / 9)),
    ).join(" "),
  );
  const head = `ncols ${side}\nnrows ${side}\nxllcorner 300000\nyllcorner 200000\ncellsize 20\nNODATA_value -9999\n`;
  writeFileSync(join(folder, "void.asc"), head + rows.join("\n"));
  itin("import void.itin void.asc --crs EPSG:27700", folder);
}

test("the page says how much is undecided and why, and a click decides it", async () => {
  writePlainWithVoid(world.folder);
  const server = await serve(world.folder, "void.itin");
  const page = await openPage(world.browser, server.address);
  await page.$eval("#place", (input) => (input.value = "300400,201300"));
  await page.$eval("#place-form button", (button) => button.click());
  await settled(page);
  await setField(page, "[name=radius]", "2000");
  await setField(page, "[name=cell]", "20");
  await settled(page);
  const options =
    "--observer 300400,201300,20 --target-height 2 --radius 2000 --cell 20 -o void.tif --overwrite --json";
  const count = (more) => JSON.parse(itin(`viewshed void.itin ${options}${more}`, world.folder)).cells;
  const { visible, hidden, undecided } = count("");
  assert.ok(undecided > 0);
  const share = `(${((100 * undecided) / (visible + hidden + undecided)).toFixed(1)} %)`;
  const said = await text(page, "#undecided-said");
  assert.match(said, /^Mast A: .* is undecided, as lines of sight there cross ground without data\./);
  assert.ok(said.includes(share), `${said}: ${share}`);
  assert.match(await text(page, "#legend-list"), /undecided/);
  await keepPicture(page, "undecided");
  assert.deepEqual(await axeFindings(page), []);

  const shareSeen = async () => Number((await text(page, ".mast-summary")).match(/([\d.]+) %$/)[1]);
  for (const nodata of ["block", "clear"]) {
    await page.$eval(`#undecided button[value=${nodata}]`, (button) => button.click());
    await settled(page);
    const cells = count(` --nodata ${nodata}`);
    const seen = (100 * cells.visible) / (cells.visible + cells.hidden + cells.undecided);
    await until(async () => Math.abs((await shareSeen()) - seen) < 0.06, `${nodata}: ${seen} %`);
    assert.equal(await page.$eval("[name=nodata]", (select) => select.value), nodata);
    assert.doesNotMatch(await text(page, "#undecided-said"), /undecided/);
    assert.equal(await page.$eval(`#undecided button[value=${nodata}]`, (button) => button.hidden), true);
  }
  await page.$eval("#undecided button[value='']", (button) => button.click());
  await settled(page);
  await until(async () => (await text(page, "#undecided-said")).includes(share), "undecided again");
  // What the program says of the ground is said in words of the page.
  assert.doesNotMatch(await text(page, "#column"), /--(sea|nodata)/);
  await closed(page);
  await server.stop();
});

test("no message names an option of the command line", async () => {
  globalThis.document = { querySelectorAll: () => [] };
  const { inPageWords } = await module("panel/page_words");
  const { verbs } = JSON.parse(itin(["--help", "--json"], world.folder));
  const names = verbs.flatMap(({ groups }) =>
    groups.flatMap(({ options }) => options.flatMap((option) => option.names)),
  );
  const long = names.filter((name) => name.startsWith("--"));
  assert.ok(long.length > 100, `${long.length} options`);
  for (const name of long) {
    for (const message of [`give ${name}`, `${name} 'x': is wrong`, `leave out ${name}, or ${name} 5`]) {
      assert.doesNotMatch(inPageWords(message), /--/);
    }
  }
  const said = inPageWords(
    "0.5 % of the area has no ground data: nothing is known of places there. --nodata says what it does to sight lines " +
      "that cross it; import a larger source, or, where it is the sea, import with --sea-level, and beyond the sources " +
      "with --sea-area",
  );
  assert.match(said, /where it is the sea, import the store anew with the elevation of the sea/);
  delete globalThis.document;
});

test("what is wrong with a place, a view or a job is said in words of the page", async () => {
  const page = await openPage(world.browser, world.hills.address);
  const add = async (place, words) => {
    await page.$eval("#place", (input, to) => (input.value = to), place);
    await page.$eval("#place-form button", (button) => button.click());
    await until(async () => words.test(await text(page, "#place-problem")), `${place}: ${words}`);
  };
  await add("-3.29,51.54", /it is in degrees: type degrees with their letters/);
  await add("500000,500000", /lies off the data.*move it onto the data$/);
  page.troubles.length = 0; // the browser notes the answers 400
  await page.$eval("#tasks input[value=sites]", (input) => input.click());
  await page.$eval("#area-in-view", (button) => button.click());
  await setField(page, "#site-height", "tall");
  await page.$eval("#choose", (button) => button.click());
  const problem = await until(() => text(page, "#choice-run .problem"), "what is wrong is said");
  assert.match(problem, /^“Mast height” 'tall'/);
  page.troubles.length = 0;
  await closed(page);
});

test("the texts of every box for a choice fit", async () => {
  const page = await pageWithMast(world.town);
  await page.mouse.click(MIDDLE.x + 60, MIDDLE.y + 40, { button: "right" });
  await settled(page);
  await page.$$eval("details", (all) => all.forEach((some) => (some.open = true)));
  for (const task of ["masts", "turbines", "sites", "premises"]) {
    await page.$eval(`#tasks input[value=${task}]`, (input) => input.click());
    const cut = await page.$$eval("#column select", (selects) => {
      const pen = document.createElement("canvas").getContext("2d");
      const ARROW = 20;
      return selects
        .filter((select) => select.offsetParent !== null)
        .flatMap((select) => {
          const { font, paddingLeft, paddingRight } = getComputedStyle(select);
          pen.font = font;
          const room = select.clientWidth - parseFloat(paddingLeft) - parseFloat(paddingRight) - ARROW;
          return [...select.options]
            .map((option) => [option.text, Math.ceil(pen.measureText(option.text).width), room])
            .filter(([, width]) => width > room);
        });
    });
    assert.deepEqual(cut, [], task);
    await keepPicture(page, `choices-${task}`);
  }
  await closed(page);
});
