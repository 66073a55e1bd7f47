// Tests of how the page looks: what each place shows, layers, light and dark, wide and on a phone.
import assert from "node:assert/strict";
import { test } from "node:test";

import {
  axeFindings,
  boxOf,
  changed,
  closed,
  pageWithMast,
  setField,
  settled,
  stillPicture,
  text,
  until,
  MIDDLE,
} from "./planner.mjs";
import { keepPicture, openPage, world } from "./served_map.mjs";

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

test("layers change the picture under the masts, and houses are drawn where they are", async () => {
  const page = await pageWithMast(world.town);
  const onMap = { clip: { x: 320, y: 0, width: 700, height: 600 } };
  await page.waitForNetworkIdle();
  await keepPicture(page, "town");
  const changes = [
    ["#relief", "slope"],
    ["#contours", "click"],
    ["#relief", "none"],
    ["#drawn-themes input", "click"],
  ];
  for (const [selector, to] of changes) {
    const before = await stillPicture(page, onMap);
    await page.$eval(
      selector,
      (field, action) => {
        if (action === "click") field.click();
        else Object.assign(field, { value: action }).dispatchEvent(new Event("change", { bubbles: true }));
      },
      to,
    );
    await changed(page, before, onMap, `${selector} ${to}`);
  }
  const share = async () => (await text(page, ".mast-summary")).match(/([\d.]+) %$/)[1];
  const withHouses = await share();
  await page.$eval("#theme-boxes input", (input) => input.click());
  await settled(page);
  assert(Number(await share()) > Number(withHouses));
  await until(() => /themes=none|draw=/.test(page.url()), "the address has the layers");
  await closed(page);
});

test("the slope is drawn when it is first asked for", async () => {
  const page = await openPage(world.browser, world.hills.address);
  const ground = { clip: { x: 400, y: 100, width: 500, height: 400 } };
  await page.waitForNetworkIdle();
  const before = await stillPicture(page, ground);
  await page.select("#relief", "slope");
  await changed(page, before, ground, "the slope is drawn");
  await closed(page);
});

for (const dark of [false, true]) {
  test(`${dark ? "dark" : "light"}: axe finds nothing serious, on a wide screen and on a phone`, async () => {
    const page = await pageWithMast(world.hills, { dark });
    await page.mouse.click(MIDDLE.x + 90, MIDDLE.y - 60);
    await page.mouse.click(MIDDLE.x + 60, MIDDLE.y + 40, { button: "right" });
    await page.$$eval("details", (all) => all.forEach((some) => (some.open = true)));
    await settled(page);
    await page.waitForSelector("#profile canvas");
    assert.deepEqual(await axeFindings(page), []);
    await keepPicture(page, dark ? "dark" : "light");

    await page.setViewport({ width: 390, height: 800, isMobile: true, hasTouch: true });
    // Chromium loads the page anew when it becomes a phone's.
    await page.waitForSelector("#line[aria-busy=false]:not([hidden])");
    await settled(page);
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
    await keepPicture(page, dark ? "phone-dark" : "phone");
    const [zoom, relief] = [await boxOf(page, ".ol-zoom-out"), await boxOf(page, "#relief-button")];
    assert.ok(zoom.y + zoom.height <= relief.y, JSON.stringify({ zoom, relief }));
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
