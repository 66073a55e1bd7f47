// The page of `itin serve` in a real browser, as a planner uses it.
import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";

import {
  axeFindings,
  boxOf,
  closed,
  downloaded,
  mastAt,
  middleOf,
  observer,
  pause,
  setField,
  settled,
  text,
  until,
  value,
} from "./planner.mjs";
import { itin, keepPicture, launchBrowser, makeStores, openPage, runLine, serve } from "./served_map.mjs";

const MIDDLE = { x: 760, y: 330 };
let stores;
let hills;
let town;
let browser;

before(async () => {
  stores = makeStores();
  [hills, town, browser] = await Promise.all([
    serve(stores.folder, "hills.itin"),
    serve(stores.folder, "town.itin"),
    launchBrowser(),
  ]);
});

after(async () => {
  await browser?.close();
  await Promise.all([hills?.stop(), town?.stop()]);
  stores?.remove();
});

/** The page with one mast in the middle of the map. */
async function pageWithMast(server = hills, options = {}) {
  const page = await openPage(browser, server.address, options);
  await page.mouse.click(MIDDLE.x, MIDDLE.y);
  await settled(page);
  return page;
}

/** What the command line counts of what observers see. */
function counted(observers, more = "") {
  const options = `--observer ${observers}${more} --target-height 2 --radius 10000 --cell 50 -o count.tif --overwrite`;
  return JSON.parse(itin(`viewshed hills.itin ${options} --json`, stores.folder)).cells;
}

async function assertSummary(page, mast) {
  const { visible, hidden, undecided } = counted(observer(mast));
  const share = ((100 * visible) / (visible + hidden + undecided)).toFixed(1);
  assert.match(await text(page, ".mast.selected .mast-summary"), new RegExp(` ${share.replace(".", "\\.")} %$`));
}

test("a click drops a mast, a drag and arrow keys move it, and the map follows", async () => {
  const page = await pageWithMast();
  const dropped = await mastAt(page);
  await assertSummary(page, dropped);
  await keepPicture(page, "mast");

  const resolution = Number(new URLSearchParams(new URL(page.url()).hash.slice(1)).get("at").split(",")[2]);
  await page.mouse.move(MIDDLE.x, MIDDLE.y);
  await page.mouse.down();
  for (let step = 1; step <= 10; ++step) await page.mouse.move(MIDDLE.x - 4 * step, MIDDLE.y + 3 * step);
  await page.mouse.up();
  await settled(page);
  const dragged = await mastAt(page);
  assert(
    Math.abs(dragged.x - dropped.x + 40 * resolution) <= 10 && Math.abs(dragged.y - dropped.y + 30 * resolution) <= 10,
  );
  await assertSummary(page, dragged);

  await page.keyboard.press("ArrowRight");
  await page.keyboard.down("Shift");
  await page.keyboard.press("ArrowUp");
  await page.keyboard.up("Shift");
  await settled(page);
  assert.deepEqual(await mastAt(page), { ...dragged, x: dragged.x + 50, y: dragged.y + 500 });
  await assertSummary(page, await mastAt(page));

  await setField(page, ".mast.selected .field-height input", "45.5");
  await settled(page);
  await assertSummary(page, { ...dragged, x: dragged.x + 50, y: dragged.y + 500, h: 45.5 });
  await closed(page);
});

test("the keyboard alone places, moves and removes masts", async () => {
  const page = await openPage(browser, hills.address);
  await page.focus("#map");
  await page.keyboard.press("Enter");
  await settled(page);
  const placed = await mastAt(page);
  assert.equal(await page.evaluate(() => document.activeElement.className), "marker");
  await page.keyboard.press("ArrowDown");
  await settled(page);
  assert.deepEqual(await mastAt(page), { ...placed, y: placed.y - 50 });
  await page.keyboard.press("Delete");
  await page.waitForFunction(() => !document.querySelector(".mast"));
  assert.match(await text(page, "#hint"), /Click the map/);
  await closed(page);
});

const groundAt = ({ x, y }) =>
  JSON.parse(itin(`los hills.itin --from ${x},${y} --to ${x},${y} --json`, stores.folder)).from.ground_m;

test("a mast goes up to the highest ground near by", async () => {
  const page = await pageWithMast();
  const dropped = await mastAt(page);
  await page.$eval(".mast.selected .actions button", (button) => button.click());
  await page.waitForFunction(
    (x) => document.querySelector(".mast.selected .field-x input").value !== String(x),
    {},
    dropped.x,
  );
  await settled(page);
  const top = await mastAt(page);
  const around = [];
  assert(Math.hypot(top.x - dropped.x, top.y - dropped.y) <= 500);
  for (let i = 0; i < 16; ++i) {
    const at = { x: dropped.x + 60 * ((i % 4) - 1.5) * 2, y: dropped.y + 60 * (Math.floor(i / 4) - 1.5) * 2 };
    around.push(groundAt(at));
  }
  assert(groundAt(top) > groundAt(dropped) && groundAt(top) >= Math.max(...around));
  await closed(page);
});

/** The document of `itin los` from the mast to what the page's address has as target. */
function lineTo(mast, page) {
  const target = new URLSearchParams(new URL(page.url()).hash.slice(1)).get("target");
  return JSON.parse(itin(`los hills.itin --from ${observer(mast)} --to ${target},2 --json`, stores.folder));
}

test("the readout says what is under the cursor, and a click shows the line of sight", async () => {
  const page = await pageWithMast();
  const mast = await mastAt(page);
  const words = { visible: /: visible/, hidden: /: hidden/, undecided: /: undecided/ };
  await page.mouse.move(MIDDLE.x + 90, MIDDLE.y - 60, { steps: 3 });
  await page.waitForSelector("#readout:not([hidden])");
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
  await closed(page);
});

test("hovering ties the profile and the map", async () => {
  const page = await pageWithMast();
  await page.mouse.click(MIDDLE.x + 200, MIDDLE.y);
  await page.waitForSelector("#profile canvas");
  await page.mouse.move(MIDDLE.x + 200, MIDDLE.y + 90); // away from the line
  await pause(500);
  const marker = await middleOf(page, ".marker");
  const middle = { x: marker.x + 100, y: marker.y };
  const around = { clip: { x: middle.x - 12, y: middle.y - 12, width: 24, height: 24 } };
  const without = await page.screenshot(around);
  const plot = await boxOf(page, ".u-over");
  await page.mouse.move(plot.x + plot.width / 2, plot.y + plot.height / 2, { steps: 2 });
  await until(async () => Buffer.compare(await page.screenshot(around), without) !== 0, "the map marks the place");
  await page.mouse.move(middle.x, middle.y + 3, { steps: 2 });
  await until(
    async () => Math.abs((await boxOf(page, ".u-cursor-x")).x - plot.x - plot.width / 2) < 0.03 * plot.width,
    "the profile's cursor follows",
  );
  await page.keyboard.press("Escape");
  await page.waitForSelector("#line[hidden]");
  await closed(page);
});

test("several masts are shown together, alone and as a difference", async () => {
  const page = await pageWithMast();
  await page.mouse.click(MIDDLE.x + 60, MIDDLE.y + 40, { button: "right" });
  await page.waitForFunction(() => document.querySelectorAll(".mast").length === 2);
  await settled(page);
  const seen = async () => (
    await page.waitForFunction(() => document.querySelector("#legend-sum").textContent !== ""),
    text(page, "#legend-sum")
  );
  const masts = [...(await text(page, "#command")).matchAll(/--observer=(\S+)/g)].map((found) => found[1]);
  const both = counted(masts.join(" "));
  const share = (100 * both.visible) / (both.visible + both.hidden + both.undecided);
  assert.match(await seen(), new RegExp(`^From any .*\\(${share.toFixed(1).replace(".", "\\.")} %\\), from all`));
  const pictures = [await keepPicture(page, "together")];
  for (const show of ["alone", "difference"]) {
    await page.$eval(`#show input[value=${show}]`, (input) => input.click());
    await pause(200);
    pictures.push(await keepPicture(page, show));
    assert.notDeepEqual(pictures.at(-1), pictures.at(-2));
  }
  assert.match(await seen(), /^Mast B alone adds /);
  await page.$eval("#masts .mast:first-child .mast-head", (head) => head.click());
  assert.match(await text(page, "#legend-list"), /only from Mast A/);
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
  assert.match(await text(page, "#line-facts"), /F1 clear.*dB free space/);
  await keepPicture(page, "fresnel");
  await closed(page);
});

test("modes with values have classes in the legend, and each place its value", async () => {
  const page = await pageWithMast();
  await setField(page, "[name=cell]", "200");
  for (const [mode, words] of [
    ["height", /up to 2 m.*over 100 m/s],
    ["angle", /over 2°/],
    ["loss", /up to 1 dB/],
  ]) {
    await page.select("select[name=mode]", mode);
    await page.waitForFunction(
      (title) => document.querySelector("#legend-list").textContent.includes(title),
      {},
      { height: "100 m", angle: "2°", loss: "dB" }[mode],
    );
    await settled(page);
    assert.match(await text(page, "#legend-list"), words);
    await keepPicture(page, mode);
  }
  await closed(page);
});

test("a reload from the address shows the same, and the key is not in it", async () => {
  const page = await pageWithMast();
  await page.mouse.click(MIDDLE.x + 90, MIDDLE.y - 60);
  await setField(page, "[name=effective-earth]", "4/3");
  await settled(page);
  await page.waitForFunction(() => location.hash.includes("effective-earth=4/3") && location.hash.includes("&target="));
  await page.waitForSelector("#line[aria-busy=false]");
  const address = page.url();
  const mast = await mastAt(page);
  const said = await text(page, "#line-verdict");
  assert.doesNotMatch(address, /key=/);
  await closed(page);
  const again = await openPage(browser, address);
  await settled(again);
  await again.waitForSelector("#line[aria-busy=false]");
  assert.deepEqual(await mastAt(again), mast);
  assert.equal(await value(again, "[name=effective-earth]"), "4/3");
  assert.equal(await text(again, "#line-verdict"), said);
  await again.waitForFunction((dropped) => location.href === dropped, {}, address);
  await closed(again);
});

test("what is downloaded is the bytes of the command line that is copied", async () => {
  const page = await pageWithMast();
  const folder = join(stores.folder, "downloads");
  const client = await page.createCDPSession();
  await client.send("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: folder });
  await browser
    .defaultBrowserContext()
    .overridePermissions(new URL(hills.address).origin, [
      "clipboard-read",
      "clipboard-write",
      "clipboard-sanitized-write",
    ]);
  mkdirSync(folder);
  await page.bringToFront();
  await page.click("#copy");
  await page.waitForFunction(() => document.querySelector("#results-said").textContent === "Copied.");
  const command = await page.evaluate(() => navigator.clipboard.readText());
  assert.equal(command, await text(page, "#command"));
  await page.$eval("[data-ending=tif]", (button) => button.click());
  assert.deepEqual(await downloaded(folder, "mast-a.tif"), runLine(command, stores.folder, "by-hand.tif"));
  await page.waitForFunction(() => document.querySelector("#results-said").textContent.startsWith("Saved"));
  await page.$eval("[data-ending=png]", (button) => button.click());
  assert.equal((await downloaded(folder, "mast-a.png")).subarray(1, 4).toString(), "PNG");
  await closed(page);
});

test("a file that takes too long is cancelled", async () => {
  const page = await pageWithMast();
  await setField(page, "[name=cell]", "10");
  await settled(page);
  await page.$eval("[data-ending=pdf]", (button) => button.click());
  await page.waitForSelector("#job:not([hidden])");
  await pause(300);
  await page.$eval("#job-cancel", (button) => button.click());
  await page.waitForSelector("#job[hidden]");
  assert.equal(await text(page, "#results-said"), "");
  await closed(page);
});

test("places are typed as the command line takes them, and what it cannot read is said in its words", async () => {
  const page = await openPage(browser, hills.address);
  const add = async (place) => {
    await page.$eval("#place", (input, to) => (input.value = to), place);
    await page.$eval("#place-form button", (button) => button.click());
  };
  await add("ST 10375 83525");
  await settled(page);
  assert.deepEqual(await mastAt(page), { x: 310375, y: 183525, h: 20 });
  await add("nowhere");
  await page.waitForFunction(() => document.querySelector("#place-problem").textContent.includes("nowhere"));
  page.troubles.length = 0; // the browser notes the answer 400
  await setField(page, "[name=radius]", "far");
  await page.waitForFunction(() => document.querySelector(".mast-summary.problem")?.textContent.includes("far"));
  assert.equal(await page.$eval("[name=radius]", (input) => input.getAttribute("aria-invalid")), "true");
  await setField(page, "[name=radius]", "5000");
  await settled(page);
  assert.match(await text(page, ".mast-summary"), /^sees /);
  await closed(page);
});

test("layers change the picture under the masts, and houses are drawn where they are", async () => {
  const page = await pageWithMast(town);
  const shown = async () => (
    await pause(300),
    await page.waitForNetworkIdle(),
    page.screenshot({ clip: { x: 320, y: 0, width: 700, height: 600 } })
  );
  let last = await shown();
  await keepPicture(page, "town");
  const changes = [
    ["#contours", "click"],
    ["#relief", "slope"],
    ["#relief", "none"],
    ["#drawn-themes input", "click"],
  ];
  for (const [selector, to] of changes) {
    await page.$eval(
      selector,
      (field, action) => {
        if (action === "click") field.click();
        else Object.assign(field, { value: action }).dispatchEvent(new Event("change", { bubbles: true }));
      },
      to,
    );
    const now = await shown();
    assert.notDeepEqual(now, last, `${selector} ${to}`);
    last = now;
  }
  const share = async () => (await text(page, ".mast-summary")).match(/([\d.]+) %$/)[1];
  const withHouses = await share();
  await page.$eval("#theme-boxes input", (input) => input.click());
  await settled(page);
  assert(Number(await share()) > Number(withHouses));
  assert.match(page.url(), /themes=none|draw=/);
  await closed(page);
});

for (const dark of [false, true]) {
  test(`${dark ? "dark" : "light"}: axe finds nothing serious, on a wide screen and on a phone`, async () => {
    const page = await pageWithMast(hills, { dark });
    await page.mouse.click(MIDDLE.x + 90, MIDDLE.y - 60);
    await page.mouse.click(MIDDLE.x + 60, MIDDLE.y + 40, { button: "right" });
    await page.$$eval("details", (all) => all.forEach((some) => (some.open = true)));
    await settled(page);
    await page.waitForSelector("#profile canvas");
    assert.deepEqual(await axeFindings(page), []);
    await keepPicture(page, dark ? "dark" : "light");

    await page.setViewport({ width: 390, height: 800, isMobile: true, hasTouch: true });
    await page.waitForSelector("#sheet-button");
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
    await keepPicture(page, dark ? "phone-dark" : "phone");
    await page.$eval("#sheet-button", (button) => button.click());
    assert.equal(await page.$eval("#sheet-button", (button) => button.getAttribute("aria-expanded")), "true");
    assert.deepEqual(await axeFindings(page), []);
    await keepPicture(page, dark ? "phone-sheet-dark" : "phone-sheet");
    const background = await page.evaluate(() =>
      getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number),
    );
    assert(dark ? background[0] < 60 : background[0] > 200);
    await closed(page);
  });
}

test("the page says when the server has gone, and when another has come", async () => {
  const first = await serve(stores.folder, "town.itin");
  const page = await openPage(browser, first.address);
  const says = (words) =>
    page.waitForFunction((wanted) => document.querySelector("#status").textContent.includes(wanted), {}, words);
  await first.stop();
  await says("does not answer");
  const second = await serve(stores.folder, "town.itin", new URL(first.address).port);
  await says("an earlier start");
  await page.close();
  await second.stop();
});

test("without the key the page says where to find it", async () => {
  const context = await browser.createBrowserContext();
  const page = await context.newPage();
  await page.goto(new URL(hills.address).origin);
  await page.waitForFunction(() => document.querySelector("#status").textContent.includes("itin serve printed"));
  await context.close();
});
