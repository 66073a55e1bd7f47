// What a planner does and sees on the page, for tests.
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";

import { axeSource, itin, openPage, world, PATIENCE } from "./served_map.mjs";

/** The middle of the map, in pixels of the page. */
export const MIDDLE = { x: 760, y: 330 };

export const text = (page, selector) => page.$eval(selector, (found) => found.textContent);
export const value = (page, selector) => page.$eval(selector, (found) => found.value);
export const mastAt = async (page) => ({
  x: Number(await value(page, ".mast.selected .field-x input")),
  y: Number(await value(page, ".mast.selected .field-y input")),
  h: Number(await value(page, ".mast.selected .field-height input")),
});
export const observer = ({ x, y, h }) => `${x},${y},${h}`;

const pause = (milliseconds) => new Promise((resume) => setTimeout(resume, milliseconds));

/** Waits until something holds, and returns what it then is. */
export async function until(holds, what) {
  for (const end = Date.now() + PATIENCE; Date.now() < end; await pause(100)) {
    const found = await holds();
    if (found) return found;
  }
  assert.fail(`in vain: ${what}`);
}

/** A picture of the page, or of a part of it, as soon as it stands still. */
export async function stillPicture(page, part = {}) {
  let last = await page.screenshot(part);
  return until(async () => {
    const before = last;
    await pause(200);
    last = await page.screenshot(part);
    return Buffer.compare(before, last) === 0 && last;
  }, "the picture stands still");
}

/** Waits until a part of the page looks unlike a picture of it. */
export const changed = (page, picture, part, what) =>
  until(async () => Buffer.compare(await page.screenshot(part), picture) !== 0, what);

/** Waits until the page has drawn what it knows. */
export const drawn = (page) =>
  page.evaluate(() => new Promise((resume) => requestAnimationFrame(() => requestAnimationFrame(resume))));

/** Waits until every mast's cells are all decided. */
export const settled = async (page) => (
  await drawn(page),
  page.waitForFunction(() => document.querySelector(".mast") && !document.querySelector(".mast.working"))
);

/** Waits until nothing is asked of the server any more, whoever sees. */
export const settledViews = async (page) => (
  await drawn(page),
  page.waitForFunction(() => document.querySelector("#status").hidden && !document.querySelector("#legend").hidden)
);

export async function setField(page, selector, wanted) {
  await page.$eval(
    selector,
    (input, to) => {
      input.closest("details")?.setAttribute("open", "");
      input.value = to;
      input.dispatchEvent(new Event("change", { bubbles: true }));
    },
    wanted,
  );
}

export async function boxOf(page, selector) {
  return page.$eval(selector, (found) => {
    const { x, y, width, height } = found.getBoundingClientRect();
    return { x, y, width, height };
  });
}

export async function middleOf(page, selector) {
  const { x, y, width, height } = await boxOf(page, selector);
  return { x: x + width / 2, y: y + height / 2 };
}

/** Closes a page on which nothing went wrong. */
export async function closed(page) {
  assert.deepEqual(page.troubles, []);
  await page.close();
}

/** A file of a folder, as soon as it is there. */
export async function downloaded(folder, name) {
  await until(() => readdirSync(folder).includes(name), `${name} is downloaded`);
  return readFileSync(join(folder, name));
}

/** Findings of axe that keep people out. */
export async function axeFindings(page) {
  await page.evaluate(axeSource);
  const { violations } = await page.evaluate(() => window.axe.run());
  return violations
    .filter(({ impact }) => ["serious", "critical"].includes(impact))
    .map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target).join(", ")}`);
}

/** The page with one mast in the middle of the map. */
export async function pageWithMast(server = world.hills, options = {}) {
  const page = await openPage(world.browser, server.address, options);
  await page.mouse.click(MIDDLE.x, MIDDLE.y);
  await settled(page);
  return page;
}

/** What the command line counts of what observers see. */
export function counted(observers, more = "") {
  const options = `--observer ${observers}${more} --target-height 2 --radius 10000 --cell 50 -o count.tif --overwrite`;
  return JSON.parse(itin(`viewshed hills.itin ${options} --json`, world.folder)).cells;
}
