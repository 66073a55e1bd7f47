// Tests of wind turbines on the map: placed, loaded, dragged, what is seen of them, and what is written.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

import { axeFindings, closed, downloaded, setField, settledViews, text, until, MIDDLE } from "./planner.mjs";
import { itin, keepPicture, openPage, world } from "./served_map.mjs";

const LAYOUT = `name,x,y,hub_height,rotor_diameter
Alpha,316000,190000,90,110
Beta,316500,190600,90,110
Gamma,317100,190200,80,100
`;

/** What `itin ztv` says of the area from which any blade tip and any hub is seen, km². */
function areaOf(layout) {
  writeFileSync(join(world.folder, "layout.csv"), layout);
  const options = "--turbines layout.csv --radius 10000 --cell 50 --observer-height 2 -o zone --overwrite --json";
  return JSON.parse(itin(`ztv hills.itin ${options}`, world.folder)).area_km2.bare;
}

const km2 = (area) => area.toFixed(area < 100 ? 1 : 0);

async function assertSeen(page, layout) {
  const { any_tip_seen: tip, any_hub_seen: hub } = areaOf(layout);
  const wanted = `a blade tip from ${km2(tip)} km²`;
  await until(async () => (await text(page, "#turbine-sum")).includes(wanted), wanted);
  assert.ok((await text(page, "#turbine-sum")).includes(`a hub from ${km2(hub)} km²`));
}

async function pageWithLayout() {
  writeFileSync(join(world.folder, "farm.csv"), LAYOUT);
  const page = await openPage(world.browser, world.hills.address);
  await page.$eval("#tasks input[value=turbines]", (input) => input.click());
  await (await page.$("#layout")).uploadFile(join(world.folder, "farm.csv"));
  await page.waitForSelector(".marker.turbine");
  await settledViews(page);
  return page;
}

test("a layout is loaded, and what is seen of it is what the zone of visibility says", async () => {
  const page = await pageWithLayout();
  assert.equal(await page.$$eval(".marker.turbine", (all) => all.length), 3);
  assert.match(await text(page, "#turbine-name"), /Alpha/);
  await assertSeen(page, LAYOUT);
  await keepPicture(page, "turbines");
  await page.$eval("#parts input[value=hubs]", (input) => input.click());
  await until(async () => (await text(page, "#legend-title")) === "Hubs seen", "the legend follows");
  assert.match(await text(page, "#legend-list"), /3.*2.*1/s);
  assert.deepEqual(await axeFindings(page), []);
  await closed(page);
});

test("counts follow a turbine that is moved, and sizes that are set", async () => {
  const page = await pageWithLayout();
  await page.focus(".marker.turbine");
  for (let i = 0; i < 3; ++i) await page.keyboard.press("ArrowLeft");
  await setField(page, "#hub-height", "60");
  await setField(page, "#rotor-diameter", "90");
  await settledViews(page);
  const moved = LAYOUT.replace("316000", "315850").replaceAll(/,\d+,\d+\n/g, ",60,90\n");
  await assertSeen(page, moved);
  await page.waitForFunction(() => location.hash.includes("turbine=315850,190000,60,105,Alpha"));
  const again = await openPage(world.browser, page.url());
  await settledViews(again);
  assert.equal(await text(again, "#turbine-sum"), await text(page, "#turbine-sum"));
  await closed(again);
  await closed(page);
});

test("turbines are placed by hand, and a click shows the wireline from there", async () => {
  const page = await openPage(world.browser, world.hills.address);
  await page.$eval("#tasks input[value=turbines]", (input) => input.click());
  await page.mouse.click(MIDDLE.x, MIDDLE.y);
  await page.mouse.click(MIDDLE.x + 30, MIDDLE.y, { button: "right" });
  await settledViews(page);
  await page.mouse.move(MIDDLE.x - 20, MIDDLE.y - 60, { steps: 3 });
  await page.waitForSelector("#readout:not([hidden])");
  assert.match(await text(page, "#readout"), /Blade tips\d of 2Hubs\d of 2Nearest turbine/);
  const middle = async () => {
    const at = new URLSearchParams(new URL(page.url()).hash.slice(1)).get("at");
    return at?.split(",").map(Number) ?? [];
  };
  await until(async () => (await middle()).length === 3, "the address has the middle of the map");
  const [x, y, resolution] = await middle();
  await page.mouse.click(MIDDLE.x - 20, MIDDLE.y + 240);
  await page.waitForSelector("#wireline-picture:not([hidden])");
  await until(() => page.$eval("#wireline-picture", (image) => image.naturalWidth > 0), "the wireline is drawn");
  assert.match(await text(page, "#wireline-said"), /^Wireline from/);
  await keepPicture(page, "wireline");
  await page.keyboard.press("Escape");
  await page.waitForSelector("#wireline[hidden]");
  await until(async () => {
    const now = await middle();
    return Math.hypot(now[0] - x, now[1] - y) < resolution;
  }, "the map is where it was");
  await page.$eval("#turbines-remove", (button) => button.click());
  assert.match(await text(page, "#turbine-sum"), /^None yet/);
  await closed(page);
});

test("the zone of visibility is written as the command line writes it", async () => {
  const page = await pageWithLayout();
  const folder = join(world.folder, "zones");
  mkdirSync(folder);
  const client = await page.createCDPSession();
  await client.send("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: folder });
  await page.$eval("#write-zone", (button) => button.click());
  await page.waitForSelector("#zone-run .run-files:not([hidden])");
  await page.$$eval("#zone-run a", (links) => links.find(({ textContent }) => textContent === "areas.csv").click());
  const table = await downloaded(folder, "areas.csv");
  areaOf(LAYOUT);
  assert.deepEqual(table, readFileSync(join(world.folder, "zone", "areas.csv")));
  await closed(page);
});

test("files that hold no turbines are refused in one line, with the planner's own name for them", async () => {
  const page = await openPage(world.browser, world.hills.address);
  await page.$eval("#tasks input[value=turbines]", (input) => input.click());
  const refused = async (name, bytes, words) => {
    writeFileSync(join(world.folder, name), bytes);
    await (await page.$("#layout")).uploadFile(join(world.folder, name));
    await until(async () => words.test(await text(page, "#layout-problem")), `${name}: ${words}`);
  };
  await refused("odd.csv", "a,b\n1,2\n", /^odd\.csv: .*must name x and y/);
  await refused("broken.geojson", "{", /^broken\.geojson: .*cannot be read/);
  await refused("picture.png", "png", /^picture\.png: choose a table/);
  await page.close();
});

test("dwellings near turbines are surveyed as the command line surveys them", async () => {
  const page = await openPage(world.browser, world.town.address);
  await page.$eval("#tasks input[value=turbines]", (input) => input.click());
  writeFileSync(join(world.folder, "rotors.csv"), "name,x,y,hub_height,rotor_diameter\nA,321950,4297600,60,50\n");
  await (await page.$("#layout")).uploadFile(join(world.folder, "rotors.csv"));
  await page.waitForSelector(".marker.turbine");
  await setField(page, "#dwelling-radius", "300");
  await setField(page, "#flicker-year", "2027");
  await setField(page, "#flicker-clock", "-5");
  await page.$eval("#survey-dwellings", (button) => button.click());
  const said = await until(() => text(page, "#dwellings-sum"), "dwellings are counted");
  const options =
    "--turbines rotors.csv --radius 300 --year 2027 --time-zone=-5 --observer-height 2 -o near --overwrite";
  const { dwellings } = JSON.parse(itin(`dwellings town.itin ${options} --json`, world.folder));
  assert.ok(said.startsWith(`${dwellings.all} dwellings: ${dwellings.see_a_tip} see a blade tip`), said);
  assert.ok(said.includes(`Shadows flicker at ${dwellings.with_flicker} in the worst case of 2027`), said);
  assert.match(await text(page, "#dwellings-run .run-files"), /dwellings\.csv/);
  await page.$eval("#dwellings", (section) => section.scrollIntoView());
  await keepPicture(page, "dwellings");
  assert.deepEqual(await axeFindings(page), []);

  await setField(page, "#flicker-year", "soon");
  await page.$eval("#survey-dwellings", (button) => button.click());
  const problem = await until(() => text(page, "#dwellings-run .problem"), "what is wrong is said");
  assert.match(problem, /^“Year of flicker” 'soon'/);
  page.troubles.length = 0; // the browser notes the answer 400
  await closed(page);
});

test("a store without buildings offers no survey of dwellings", async () => {
  const page = await openPage(world.browser, world.hills.address);
  assert.equal(await page.$eval("#dwellings", (section) => section.hidden), true);
  await closed(page);
});
