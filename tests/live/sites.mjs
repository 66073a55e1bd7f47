// Tests of the choice of sites, and of the survey of premises.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

import { axeFindings, closed, drawn, pageWithMast, setField, settledViews, text, until, MIDDLE } from "./planner.mjs";
import { itin, keepPicture, openPage, world } from "./served_map.mjs";

const CANDIDATES = `name,x,y,height
Ridge,316000,190000,20
Top,310375,183525,20
Moor,322000,196000,25
Vale,318000,184000,20
`;

/** What `itin site` says of a choice among the candidates. */
function chosenOf(options) {
  writeFileSync(join(world.folder, "candidates.csv"), CANDIDATES);
  const all = `--candidates candidates.csv --radius 10000 --cell 200 --target-height 2 -o sites --overwrite --json`;
  return JSON.parse(itin(`site hills.itin ${all} ${options}`, world.folder));
}

/** The page with options for a quick choice. */
async function pageOfSites() {
  const page = await openPage(world.browser, world.hills.address);
  await page.$eval("#tasks input[value=sites]", (input) => input.click());
  await setField(page, "[name=cell]", "200");
  return page;
}

/** A place within a house of the town, and how high that rises above the ground there. */
function middleOfHouse() {
  itin("tin town.itin --all --themes buildings -o town.geojson --overwrite", world.folder);
  const { features } = JSON.parse(readFileSync(join(world.folder, "town.geojson"), "utf8"));
  const roofs = features.filter(({ properties }) => properties.theme === "buildings");
  const [ring] = roofs.at(40).geometry.coordinates;
  const mean = (axis) => Number(((ring[0][axis] + ring[1][axis] + ring[2][axis]) / 3).toFixed(3));
  const [x, y] = [mean(0), mean(1)];
  const { from } = JSON.parse(itin(`los town.itin --from ${x},${y},0 --to ${x},${y},0 --json`, world.folder));
  return { x, y, top: from.surface_m - from.ground_m };
}

const load = async (page, name, text_) => {
  writeFileSync(join(world.folder, name), text_);
  await (await page.$("#candidates")).uploadFile(join(world.folder, name));
};

async function loadCandidates(page) {
  await load(page, "places.csv", CANDIDATES);
  await until(async () => /^4 candidates of places\.csv/.test(await text(page, "#search-said")), "candidates are told");
}

async function choose(page, count) {
  await setField(page, "#site-count", String(count));
  await page.$eval("#choose", (button) => button.click());
  await page.waitForSelector("#plan:not([hidden])");
  await settledViews(page);
  await drawn(page);
}

test("sites are chosen among places of a file; what each adds, and what a swap costs, is what the command line says", async () => {
  const page = await pageOfSites();
  await loadCandidates(page);
  await choose(page, 2);
  const { chosen, value, served_percent: percent } = chosenOf("--count 2 --name-field name");
  const km2 = (cells) => `${((cells * 200 ** 2) / 1e6).toFixed((cells * 200 ** 2) / 1e6 < 100 ? 1 : 0)} km²`;
  assert.ok(
    (await text(page, "#plan-sum")).includes(`serve ${km2(value)}: ${percent.toFixed(1)} % of what lies within 10 km`),
  );
  const rows = await page.$$eval("#plan-sites .site-gain", (all) => all.map(({ textContent }) => textContent));
  assert.deepEqual(
    rows,
    chosen.map(({ gain }) => `adds ${km2(gain)}`),
  );
  assert.deepEqual(
    await page.$$eval("#plan-sites .mast-name", (all) => all.map(({ textContent }) => textContent)),
    chosen.map(({ id }) => id),
  );
  await keepPicture(page, "sites");
  assert.deepEqual(await axeFindings(page), []);

  // The second site goes by hand to where a candidate was not chosen.
  await page.$$eval(".site", (all) => all[1].click());
  const free = CANDIDATES.split("\n")
    .slice(1, 5)
    .map((line) => line.split(",").slice(1, 3).map(Number))
    .find(([x, y]) => !chosen.some((site) => site.x === x && site.y === y));
  const [cx, cy, resolution] = new URLSearchParams(new URL(page.url()).hash.slice(1)).get("at").split(",").map(Number);
  const box = await page.$eval("#map", (map) => {
    const { x, y, width, height } = map.getBoundingClientRect();
    return { x: x + width / 2, y: y + height / 2 };
  });
  await page.mouse.click(box.x + (free[0] - cx) / resolution, box.y - (free[1] - cy) / resolution);
  await page.waitForSelector(".marker.moved");
  await settledViews(page);
  writeFileSync(
    join(world.folder, "swapped.csv"),
    `x,y,height\n${chosen[0].x},${chosen[0].y},${chosen[0].height_m}\n${free.join(",")},${chosen[1].height_m}\n`,
  );
  const swapped = JSON.parse(
    itin(
      "viewshed hills.itin --observers swapped.csv --height-field height --target-height 2 --radius 10000 --cell 200 " +
        "-o swapped.tif --overwrite --json",
      world.folder,
    ),
  ).cells.visible;
  await until(
    async () => (await text(page, "#plan-now")).startsWith(`Now ${km2(swapped)}: ${km2(value - swapped)}`),
    `${await text(page, "#plan-now")}: ${km2(swapped)}, ${km2(value - swapped)}`,
  );
  assert.match(await text(page, "#plan-now"), /less than the choice/);
  await keepPicture(page, "swap");
  await page.$eval("#plan-back", (button) => button.click());
  await page.waitForFunction(() => !document.querySelector(".marker.moved"));
  await page.$eval("#plan-keep", (button) => button.click());
  await page.waitForFunction(() => document.querySelectorAll(".mast").length === 2);
  await closed(page);
});

/** Says what is to be served, and waits until the page says it. */
async function serve(page, kind, words) {
  await page.select("#served", kind);
  await until(async () => words.test(await text(page, "#served-said")), `${words}`);
}

test("sites serve places of a file, and the result says of which", async () => {
  const page = await pageOfSites();
  assert.match(await text(page, "#served-said"), /^To be served: all ground within 10 km of a candidate\.$/);
  await loadCandidates(page);
  await serve(page, "places", /^Load the households/);
  await page.$eval("#choose", (button) => button.click());
  await until(async () => /^Load the places/.test(await text(page, "#choice-run .problem")), "places are asked for");
  const homes = Array.from({ length: 40 }, (_, i) => `${312000 + 250 * (i % 8)},${184000 + 900 * Math.floor(i / 8)}`);
  writeFileSync(join(world.folder, "homes.csv"), `x,y\n${homes.join("\n")}\n`);
  await (await page.$("#served-places")).uploadFile(join(world.folder, "homes.csv"));
  await until(async () => /the 40 places of homes\.csv/.test(await text(page, "#served-said")), "they are told");
  await choose(page, 2);
  const { value } = chosenOf("--count 2 --name-field name --demand homes.csv");
  const sum = await text(page, "#plan-sum");
  assert.ok(
    sum.includes(`${value} places: ${((100 * value) / 40).toFixed(1)} % of the places of homes.csv (40 places)`),
    sum,
  );
  assert.match(sum, /2 were asked for: one more would add nothing\.$/);
  assert.match(await text(page, "#choice-run .run-files"), /demand\.csv a row for each point/);
  await keepPicture(page, "served-places");
  await page.focus(".marker");
  for (let i = 0; i < 3; ++i) await page.keyboard.press("ArrowRight");
  await until(
    async () => /^Now about \d+ places?: .* the choice\./.test(await text(page, "#plan-now")),
    "a move is told",
  );
  await closed(page);
});

test("sites serve the ground in view or in an area that is drawn", async () => {
  const page = await pageOfSites();
  await loadCandidates(page);
  await serve(page, "area", /^Draw the area/);
  await page.$eval("#served-button", (button) => button.click());
  for (const [x, y] of [
    [-60, -80],
    [60, -80],
    [60, 40],
    [-60, -80],
  ]) {
    await page.mouse.click(MIDDLE.x + x, MIDDLE.y + y);
    await new Promise((resume) => setTimeout(resume, 300)); // sooner, two clicks are a double one
  }
  await until(async () => /km² of ground in the area drawn/.test(await text(page, "#served-said")), "the area is told");
  // It is not the area where masts may stand.
  assert.match(await text(page, "#search-said"), /^4 candidates of/);
  await page.waitForFunction(() => location.hash.includes("&served="));
  await choose(page, 2);
  assert.match(await text(page, "#plan-sum"), /serves? [\d.]+ km²: [\d.]+ % of the area drawn \([\d.]+ km²\)/);
  await keepPicture(page, "served-area");

  // The choice in the page and what the map shows of it are one number.
  await page.focus(".marker");
  for (const key of ["ArrowRight", "ArrowLeft"]) await page.keyboard.press(key);
  await settledViews(page);
  await drawn(page);
  await serve(page, "view", /^To be served: [\d.\s]+ km² of ground, all that is in view/);
  await choose(page, 1);
  assert.match(await text(page, "#plan-sum"), /^The site serves [\d.\s]+ km²: [\d.]+ % of the ground that was in view/);
  await closed(page);
});

/** A page opened anew at the address of another one, as soon as that is the address of what it shows. */
async function reopened(page, part) {
  await page.waitForFunction((text_) => location.hash.includes(text_), {}, part);
  await new Promise((resume) => setTimeout(resume, 500));
  const again = await openPage(world.browser, page.url());
  await settledViews(again);
  return again;
}

test("a choice of sites and the files that it was made of are there again after a reload", async () => {
  const page = await pageOfSites();
  await load(page, "places.csv", `${CANDIDATES}Nowhere,abc,1,2\nFar,100,100,20\n`);
  await until(async () => /^4 candidates of places\.csv/.test(await text(page, "#search-said")), "candidates are told");
  assert.match(
    await text(page, "#candidates-problem"),
    /^2 rows cannot be used: feature 5: its x 'abc' is not a number; feature 6: lies off the data/,
  );
  await keepPicture(page, "left-out");
  await serve(page, "places", /^Load the households/);
  writeFileSync(join(world.folder, "few.csv"), "x,y\n312000,184000\n314000,188000\n316000,190000\n");
  await (await page.$("#served-places")).uploadFile(join(world.folder, "few.csv"));
  await until(async () => /the 3 places of few\.csv/.test(await text(page, "#served-said")), "they are told");
  await choose(page, 2);
  await page.focus(".marker");
  for (let i = 0; i < 3; ++i) await page.keyboard.press("ArrowRight");
  await until(async () => /^Now about/.test(await text(page, "#plan-now")), "a move is told");
  const shown = (some) =>
    some.evaluate(() =>
      ["search-said", "served-said", "plan-sum", "plan-sites", "choice-run"].map(
        (id) => document.getElementById(id).innerText,
      ),
    );
  const again = await reopened(page, "&site=0,");
  assert.deepEqual(await shown(again), await shown(page));
  assert.equal(await again.$eval("#site-count", (input) => input.value), "2");
  assert.match(await text(again, "#plan-sites"), /moved; added/);
  await closed(again);

  // A file or a result that the server has let go of is missed in plain words.
  const address = new URLSearchParams(new URL(page.url()).hash.slice(1));
  const [upload] = address.get("candidates").split(",");
  const job = address.get("choice");
  const key = await page.evaluate(() => localStorage.getItem("itin-key"));
  const { origin } = new URL(page.url());
  for (const path of [`uploads/${upload}`, `jobs/${job}`]) {
    const gone = await fetch(`${origin}/api/v1/${path}`, { method: "DELETE", headers: { "X-Itin-Key": key } });
    assert.equal(gone.status, 200, path);
  }
  const late = await openPage(world.browser, page.url());
  await until(async () => /^places\.csv is gone: /.test(await text(late, "#candidates-problem")), "the file is missed");
  assert.match(await text(late, "#choice-run .problem"), /^The choice of sites is gone: .* Choose sites again\.$/);
  assert.match(await text(late, "#served-said"), /the 3 places of few\.csv/);
  await keepPicture(late, "gone");
  late.troubles.length = 0; // the browser notes the answers 404
  await closed(late);
  await closed(page);
});

test("sites serve buildings", async () => {
  const page = await openPage(world.browser, world.town.address);
  await page.$eval("#tasks input[value=sites]", (input) => input.click());
  await page.$eval("#area-in-view", (button) => button.click());
  await setField(page, "#site-spacing", "200");
  await serve(page, "premises", /^To be served: the buildings within 200 m of a candidate/);
  await choose(page, 1);
  assert.match(
    await text(page, "#plan-sum"),
    /^The site serves \d+ buildings: [\d.]+ % of the buildings within reach \(\d+ buildings\)/,
  );
  await closed(page);
});

test("an area is drawn, a choice in it is cancelled, and then made", async () => {
  const page = await pageOfSites();
  await page.$eval("#choose", (button) => button.click());
  await until(async () => /draw an area/.test(await text(page, "#choice-run .problem")), "an area is asked for");
  await page.$eval("#area-button", (button) => button.click());
  assert.match(await text(page, "#hint"), /^Click the corners/);
  for (const [x, y] of [
    [-60, -60],
    [60, -60],
    [60, 60],
    [-60, -60],
  ]) {
    await page.mouse.click(MIDDLE.x + x, MIDDLE.y + y);
    await new Promise((resume) => setTimeout(resume, 300)); // sooner, two clicks are a double one
  }
  await until(async () => /^Candidates are proposed in/.test(await text(page, "#search-said")), "the area is told");
  assert.equal(await text(page, "#choice-run .problem"), "");
  await page.waitForSelector("#hint[hidden]");
  await page.waitForFunction(() => location.hash.includes("&area="));
  await setField(page, "#site-spacing", "300");
  await page.$eval("#choose", (button) => button.click());
  await page.waitForSelector("#choice-run .run-now:not([hidden])");
  await page.$eval("#choice-run .run-now button", (button) => button.click());
  await page.waitForSelector("#choice-run .run-now[hidden]");
  assert.equal(await page.$eval("#plan", (plan) => plan.hidden), true);
  await setField(page, "#site-spacing", "2500");
  await choose(page, 1);
  assert.match(await text(page, "#plan-sum"), /^The site serves .* No choice serves more/);
  assert.match(await text(page, "#choice-run .run-files"), /report\.html/);
  await closed(page);
});

test("a choice ends with the page that asked for it", async () => {
  const page = await pageOfSites();
  const asked = new Set();
  page.on("request", (request) => asked.add(request.url()));
  await page.$eval("#area-in-view", (button) => button.click());
  await setField(page, "#site-spacing", "300");
  await page.$eval("#choose", (button) => button.click());
  const job = await until(() => [...asked].find((url) => /\/jobs\/\w+$/.test(url)), "the choice has begun");
  assert.equal((await (await fetch(job)).json()).error, null);
  await page.goto("about:blank");
  await until(async () => (await fetch(job)).status === 404, "the server has let go of it");
  await page.close();
});

test("premises are surveyed from the masts on the map", async () => {
  const page = await pageWithMast(world.town);
  await page.$eval("#tasks input[value=premises]", (input) => input.click());
  await page.$eval("#survey-premises", (button) => button.click());
  await until(async () => (await text(page, "#premises-sum")) !== "", "buildings are counted");
  const [x, y, h] = await page.$$eval(".mast.selected .mast-fields input", (all) => all.slice(1).map((i) => i.value));
  writeFileSync(join(world.folder, "one.csv"), `x,y,height\n${x},${y},${h}\n`);
  const radius = await page.$eval("[name=radius]", (input) => input.value);
  const { premises } = JSON.parse(
    itin(`premises town.itin --masts one.csv --radius ${radius} -o premises --overwrite --json`, world.folder),
  );
  assert.ok((await text(page, "#premises-sum")).startsWith(`${premises.served} of ${premises.all} buildings served`));
  assert.match(await text(page, "#premises-run .run-files"), /premises\.csv/);
  await until(async () => /building served on a wall/.test(await text(page, "#legend-list")), "buildings are drawn");
  const stale = () => page.$eval("#premises-run", (box) => /Out of date/.test(box.innerText));
  assert.equal(await stale(), false);
  assert.match(
    await text(page, "#premises-run .run-warnings"),
    /5 buildings not counted: the import of theme 'buildings'/,
  );
  await keepPicture(page, "premises");
  assert.deepEqual(await axeFindings(page), []);
  await setField(page, ".mast.selected .field-height input", "5");
  await until(stale, "the survey is out of date");
  await setField(page, ".mast.selected .field-height input", h);
  await until(async () => !(await stale()), "it is of what would be asked again");
  await closed(page);
});

test("a mast inside a building says so, and a click puts it on the roof", async () => {
  const page = await pageWithMast(world.town);
  await page.$eval("#tasks input[value=premises]", (input) => input.click());
  assert.equal(await page.$eval("#inside", (card) => card.hidden), true);
  const { x, y, top } = middleOfHouse();
  await page.$eval("#place", (input, to) => (input.value = to), `${x},${y},1`);
  await page.$eval("#place-form button", (button) => button.click());
  await page.waitForSelector("#inside:not([hidden])");
  const metres = (height) => `${Math.abs(height).toFixed(1)} m`;
  const where = "Mast B stands on the ground within buildings, ";
  assert.equal(await text(page, "#inside-said"), `${where}${metres(top - 1)} below the top, and sees nothing.`);
  await keepPicture(page, "inside");
  assert.deepEqual(await axeFindings(page), []);
  await setField(page, ".mast.selected .field-height input", "30");
  const above = `${where}and rises ${metres(30 - top)} above the top.`;
  await until(async () => (await text(page, "#inside-said")) === above, above);
  await page.click("#inside-up");
  await page.waitForSelector("#inside[hidden]");
  assert.match(await text(page, "#command"), /--observer-on=surface/);
  await closed(page);
});

test("a store without buildings offers no survey of them", async () => {
  const page = await openPage(world.browser, world.hills.address);
  assert.equal(await page.$eval("#premises-task", (label) => label.hidden), true);
  await closed(page);
});
