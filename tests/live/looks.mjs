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

test("modes follow each other, each with its own options", async () => {
  const page = await pageWithMast();
  await setField(page, "[name=cell]", "200");
  for (const mode of ["probability", "visible", "loss", "height", "visible"]) {
    await page.select("select[name=mode]", mode);
    await settled(page);
    assert.equal(await page.$(".mast-summary.problem"), null, mode);
    assert.match(await text(page, ".mast-summary"), /^sees/);
  }
  assert.equal(
    await page.$eval("#command", (command) => /loss|frequency|vertical-error/.test(command.textContent)),
    false,
  );
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

test("the page tells how many buildings the import left out", async () => {
  const page = await openPage(world.browser, world.town.address);
  assert.match(await text(page, "#about"), /buildings79 features; 5 more do not stand, as the import left them out/);
  await closed(page);
});

test("contours have their heights", async () => {
  const page = await openPage(world.browser, world.hills.address);
  await page.waitForNetworkIdle();
  await page.$eval("#contours", (input) => input.click());
  await page.waitForNetworkIdle();
  await keepPicture(page, "contours");
  await closed(page);
});

/** Whether something is seen whole on the map, and nothing lies over its middle. */
const isInTheOpen = (page, selector) =>
  page.$eval(selector, (found) => {
    const [map, own] = [document.querySelector("#map"), found].map((some) => some.getBoundingClientRect());
    const top = document.elementFromPoint(own.x + own.width / 2, own.y + own.height / 2);
    return (
      own.top >= map.top && own.bottom <= map.bottom && own.left >= map.left && own.right <= map.right && top === found
    );
  });

test("on a phone a place that is tapped stays in view, whatever panel opens", async () => {
  const page = await openPage(world.browser, world.hills.address, { width: 390 });
  await page.touchscreen.tap(195, 330);
  await settled(page);
  for (const y of [200, 480, 560]) {
    await page.touchscreen.tap(120, y);
    await page.waitForSelector("#line[aria-busy=false]:not([hidden])");
    await until(() => isInTheOpen(page, ".target"), `the place tapped at ${y} is in the open`);
    await keepPicture(page, `phone-line-${y}`);
    await page.$eval("#line-close", (button) => button.click());
    await page.waitForSelector("#line[hidden]");
  }
  await page.touchscreen.tap(120, 480);
  await page.waitForSelector("#line[aria-busy=false]:not([hidden])");
  await page.$eval("#sheet-button", (button) => button.click());
  await until(() => isInTheOpen(page, ".target"), "above the sheet");
  await keepPicture(page, "phone-line-sheet");
  await page.$eval("#sheet-button", (button) => button.click());

  await page.$eval("#tasks input[value=turbines]", (input) => input.click());
  await page.touchscreen.tap(195, 330);
  await page.waitForSelector(".marker.turbine");
  await page.touchscreen.tap(120, 480);
  await page.waitForSelector("#wireline:not([hidden])");
  await until(() => isInTheOpen(page, ".eye"), "the viewpoint is above the wireline");
  await until(() => page.$eval("#wireline-picture", (image) => image.naturalWidth > 0), "the wireline is drawn");
  assert.ok(await isInTheOpen(page, ".eye"));
  await keepPicture(page, "phone-wireline");
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
  await closed(page);
});
