// What a planner does and sees on the page, for tests.
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";

import { axeSource, itin, openPage, world } from "./served_map.mjs";

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

export const pause = (milliseconds) => new Promise((resume) => setTimeout(resume, milliseconds));

/** Waits until something holds, for half a minute at most: the machine may be busy. */
export async function until(holds, what) {
  for (let tries = 0; tries < 300; ++tries) {
    if (await holds()) return;
    await pause(100);
  }
  assert.fail(`in vain: ${what}`);
}

/** Waits until the page has drawn what it knows. */
export const drawn = (page) =>
  page.evaluate(() => new Promise((resume) => requestAnimationFrame(() => requestAnimationFrame(resume))));

/** Waits until every mast's cells are all decided. */
export const settled = async (page) => (
  await drawn(page),
  page.waitForFunction(() => document.querySelector(".mast") && !document.querySelector(".mast.working"), {
    timeout: 30000,
  })
);

/** Waits until nothing is asked of the server any more, whoever sees. */
export const settledViews = async (page) => (
  await drawn(page),
  page.waitForFunction(() => document.querySelector("#status").hidden && !document.querySelector("#legend").hidden, {
    timeout: 30000,
  })
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
  for (let tries = 0; tries < 100; ++tries) {
    if (readdirSync(folder).includes(name)) return readFileSync(join(folder, name));
    await pause(100);
  }
  throw new Error(`no ${name} in ${readdirSync(folder)}`);
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
