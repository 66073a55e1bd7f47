// Tests of masts on the map: placed, moved, and what they see alone and together.
import assert from "node:assert/strict";
import { test } from "node:test";

import {
  changed,
  closed,
  counted,
  mastAt,
  observer,
  pageWithMast,
  setField,
  settled,
  stillPicture,
  text,
  until,
  MIDDLE,
} from "./planner.mjs";
import { itin, keepPicture, openPage, world } from "./served_map.mjs";

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
  const page = await openPage(world.browser, world.hills.address);
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

test("what was done by mistake is taken back, by keys and by buttons", async () => {
  const page = await pageWithMast();
  const dropped = await mastAt(page);
  await page.mouse.move(MIDDLE.x, MIDDLE.y);
  await page.mouse.down();
  await page.mouse.move(MIDDLE.x + 40, MIDDLE.y, { steps: 5 });
  await page.mouse.up();
  const dragged = await mastAt(page);
  assert.notDeepEqual(dragged, dropped);
  await page.keyboard.press("Delete");
  await page.waitForFunction(() => !document.querySelector(".mast"));
  const chord = async (...keys) => {
    for (const key of keys.slice(0, -1)) await page.keyboard.down(key);
    await page.keyboard.press(keys.at(-1));
    for (const key of keys.slice(0, -1)) await page.keyboard.up(key);
  };
  await chord("Control", "z");
  await settled(page);
  assert.deepEqual(await mastAt(page), dragged);
  await assertSummary(page, dragged);
  await chord("Control", "z");
  assert.deepEqual(await mastAt(page), dropped);
  await page.click("#undo");
  await page.waitForFunction(() => !document.querySelector(".mast") && document.querySelector("#undo").disabled);
  for (let i = 0; i < 2; ++i) await page.click("#redo");
  assert.deepEqual(await mastAt(page), dragged);
  await chord("Control", "Shift", "z");
  await page.waitForFunction(() => !document.querySelector(".mast") && document.querySelector("#redo").disabled);
  await page.click("#undo");
  // In a field these keys are the text's own, which counts.
  const height = await page.$(".mast.selected .field-height input");
  await height.click({ clickCount: 3 });
  await page.keyboard.type("70");
  await page.waitForFunction(() => document.querySelector("#command").textContent.includes(",70 "));
  await chord("Control", "z");
  await page.waitForFunction(() => document.querySelector("#command").textContent.includes(",20 "));
  await closed(page);
});

test("a number counts while it is typed", async () => {
  const page = await pageWithMast();
  const dropped = await mastAt(page);
  const type = async (selector, typed) => {
    await (await page.$(selector)).click({ clickCount: 3 });
    await page.keyboard.type(typed);
  };
  await type(".mast.selected .field-height input", "62");
  await page.waitForFunction(() => document.querySelector("#command").textContent.includes(",62 "));
  await type("[name=radius]", "3000");
  await page.waitForFunction(() => document.querySelector("#command").textContent.includes("--radius=3000 "));
  // A place that is half typed moves nothing: it counts once the field is left.
  await type(".mast.selected .field-x input", String(dropped.x + 300));
  await new Promise((resume) => setTimeout(resume, 600));
  assert.ok((await text(page, "#command")).includes(`${dropped.x},`));
  await page.mouse.click(MIDDLE.x + 150, MIDDLE.y);
  await page.waitForFunction(
    (x) => document.querySelector("#command").textContent.includes(`${x},`),
    {},
    dropped.x + 300,
  );
  await closed(page);
});

test("a button shows the whole map", async () => {
  const page = await openPage(world.browser, world.hills.address);
  const where = () => new URLSearchParams(new URL(page.url()).hash.slice(1)).get("at");
  await page.waitForFunction(() => location.hash.includes("&at="));
  const whole = where();
  await page.click(".ol-zoom-in");
  await until(() => where() !== whole, "the map is nearer");
  await page.click("#whole-map");
  await until(() => where() === whole, "the map is shown whole");
  await closed(page);
});

test("a finger places and drags a mast on a phone", async () => {
  const page = await openPage(world.browser, world.hills.address, { width: 390 });
  await page.touchscreen.tap(195, 300);
  await settled(page);
  const placed = await mastAt(page);
  await page.touchscreen.touchStart(195, 300);
  for (let step = 1; step <= 8; ++step) await page.touchscreen.touchMove(195 + 5 * step, 300);
  await page.touchscreen.touchEnd();
  await settled(page);
  const dragged = await mastAt(page);
  assert.ok(dragged.x > placed.x + 1000 && Math.abs(dragged.y - placed.y) <= 5, JSON.stringify({ placed, dragged }));
  await page.touchscreen.tap(195, 200);
  await page.waitForSelector("#line[aria-busy=false]:not([hidden])");
  await closed(page);
});

const groundAt = ({ x, y }) =>
  JSON.parse(itin(`los hills.itin --from ${x},${y} --to ${x},${y} --json`, world.folder)).from.ground_m;

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
  for (let i = 0; i < 9; ++i) {
    const at = { x: dropped.x + 60 * ((i % 3) - 1) * 3, y: dropped.y + 60 * (Math.floor(i / 3) - 1) * 3 };
    around.push(groundAt(at));
  }
  assert(groundAt(top) > groundAt(dropped) && groundAt(top) >= Math.max(...around));
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
  await keepPicture(page, "together");
  const onMap = { clip: { x: MIDDLE.x - 200, y: MIDDLE.y - 200, width: 400, height: 400 } };
  for (const show of ["alone", "difference"]) {
    const before = await stillPicture(page, onMap);
    await page.$eval(`#show input[value=${show}]`, (input) => input.click());
    await changed(page, before, onMap, `the map shows masts ${show}`);
    await keepPicture(page, show);
  }
  assert.match(await seen(), /^Mast B alone adds /);
  await page.$eval("#masts .mast:first-child .mast-head", (head) => head.click());
  assert.match(await text(page, "#legend-list"), /only from Mast A/);
  const mixtures = async () => {
    await page.$eval("#show input[value=together]", (input) => input.click());
    await settled(page);
    return page.$$eval("#legend-list li", (all) =>
      all.map((item) => [item.querySelectorAll(".swatch").length, item.textContent]).slice(-4),
    );
  };
  assert.deepEqual((await mixtures()).at(-1), [1, "from both"]);
  await page.mouse.click(MIDDLE.x - 60, MIDDLE.y + 40, { button: "right" });
  const three = ["from A and B", "from A and C", "from B and C", "from all"].map((words) => [1, words]);
  assert.deepEqual(await mixtures(), three);
  await page.mouse.click(MIDDLE.x - 60, MIDDLE.y - 60, { button: "right" });
  assert.deepEqual((await mixtures()).at(-1), [6, "mixtures: from several"]);
  await keepPicture(page, "mixtures");
  await closed(page);
});

test("places are typed as the command line takes them, and what it cannot read is said in its words", async () => {
  const page = await openPage(world.browser, world.hills.address);
  const add = async (place) => {
    await page.$eval("#place", (input, to) => (input.value = to), place);
    await page.$eval("#place-form button", (button) => button.click());
  };
  await add("ST 10375 83525");
  await settled(page);
  assert.deepEqual(await mastAt(page), { x: 310375, y: 183525, h: 20 });
  // As the map itself tells places, and with a height.
  for (const [typed, x] of [
    ["311 000 E 184 000 N", 311000],
    ["311500 184000", 311500],
    ["312000,184000,35", 312000],
  ]) {
    await add(typed);
    await until(async () => (await mastAt(page)).x === x, typed);
  }
  assert.equal((await mastAt(page)).h, 35);
  await page.$eval("#place-name", (input) => (input.value = "Ridge, north"));
  await add("313000,184000");
  await until(async () => (await text(page, ".mast.selected .mast-name")) === "Ridge  north", "it has its name");
  await add("nowhere");
  await page.waitForFunction(() => document.querySelector("#place-problem").textContent.includes("nowhere"));
  page.troubles.length = 0; // the browser notes the answer 400
  await setField(page, "[name=radius]", "far");
  await page.waitForFunction(() => document.querySelector(".mast-summary.problem")?.textContent.includes("far"));
  assert.equal(await page.$eval("[name=radius]", (input) => input.getAttribute("aria-invalid")), "true");
  await setField(page, "[name=radius]", "50000");
  await setField(page, "[name=cell]", "1");
  await page.waitForFunction(() =>
    document
      .querySelector(".mast-summary.problem")
      ?.textContent.includes("take a radius of 2500 m or less, or a cell of 20 m or more"),
  );
  await keepPicture(page, "too-many-cells");
  await setField(page, "[name=cell]", "50");
  await setField(page, "[name=radius]", "5000");
  await settled(page);
  assert.match(await text(page, ".mast-summary"), /^sees /);
  await closed(page);
});
