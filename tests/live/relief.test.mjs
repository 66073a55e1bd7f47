// The 3-D view in a real browser that draws with WebGL, in software.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { axeFindings, changed, closed, settled, stillPicture, text, until } from "./planner.mjs";
import { keepPicture, launchBrowser, openPage, startWorld, stopWorld, world } from "./served_map.mjs";

before(async () => {
  await startWorld();
  await world.browser.close();
  world.browser = await launchBrowser(["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]);
});
after(stopWorld);

/** The page with a mast, and the paths of all that it has asked for. */
async function pageThatAsks(server, options) {
  const page = await openPage(world.browser, server.address, options);
  const asked = [];
  page.on("request", (request) => asked.push(new URL(request.url()).pathname));
  await page.mouse.click(760, 330);
  await settled(page);
  return { page, asked };
}

async function open(page) {
  await page.$eval("#relief-button", (button) => button.click());
  await page.waitForFunction(
    () => document.querySelector("#relief-picture canvas") && document.querySelector("#relief-said").textContent === "",
  );
}

/** How many pixels of the view have about the first mast's colour. */
async function blueIn(page) {
  const bytes = await page.screenshot({ encoding: "base64", clip: { x: 320, y: 60, width: 860, height: 700 } });
  return page.evaluate(async (picture) => {
    const image = new Image();
    image.src = `data:image/png;base64,${picture}`;
    await image.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    let blue = 0;
    for (let i = 0; i < data.length; i += 4) blue += data[i] < 120 && data[i + 2] > data[i] + 40 && data[i + 2] < 190;
    return blue;
  }, bytes);
}

test("the view is loaded when it is opened, coloured by what is seen, from outside and from the mast", async () => {
  const { page, asked } = await pageThatAsks(world.hills);
  assert.ok(!asked.some((path) => /three|relief_scene|tin\.glb/.test(path)));
  await open(page);
  assert.ok(asked.includes("/page/vendor/three.js") && asked.includes("/tin.glb"));
  assert.ok(await (await page.$("#relief-view #legend")).isVisible());
  assert.match(await text(page, "#legend-list"), /^from Mast A$/);
  await keepPicture(page, "relief");
  const coloured = await blueIn(page);
  assert.ok(coloured > 2000, String(coloured));
  assert.deepEqual(await axeFindings(page), []);

  // With a low mast less is seen, and the view follows.
  await page.$eval(".mast.selected .field-height input", (input) => {
    input.value = "0.1";
    input.dispatchEvent(new Event("change", { bubbles: true }));
  });
  await settled(page);
  await until(async () => (await blueIn(page)) < coloured, "the view follows the mast");

  await page.$eval("#relief-inside", (button) => button.click());
  await page.waitForFunction(() => /^Eyes/.test(document.querySelector("#relief-said").textContent));
  await keepPicture(page, "relief-eye");
  const straight = await stillPicture(page);
  await page.focus("#relief-picture");
  await page.keyboard.press("ArrowLeft");
  await changed(page, straight, {}, "the head is turned");
  await page.keyboard.press("Escape");
  await page.waitForSelector("#relief-view[hidden]");
  await closed(page);
});

test("houses stand on the ground, in the dark as well", async () => {
  const { page } = await pageThatAsks(world.town, { dark: true });
  await open(page);
  assert.equal(await text(page, "#standing-list"), "buildings");
  await keepPicture(page, "relief-town");
  await page.$eval("#relief-close", (button) => button.click());
  await page.waitForSelector("#relief-view[hidden]");
  assert.equal(await (await page.$("#standing")).isVisible(), false);
  assert.ok(await (await page.$("#map #legend")).isVisible());
  await closed(page);
});

test("a browser that cannot draw it says so in one line, and the map goes on", async () => {
  const page = await openPage(world.browser, world.hills.address);
  await page.evaluate(() => {
    window.HTMLCanvasElement.prototype.getContext = () => null;
  });
  await page.$eval("#relief-button", (button) => button.click());
  await page.waitForFunction(() => /cannot be shown/.test(document.querySelector("#relief-said").textContent));
  await page.$eval("#relief-close", (button) => button.click());
  await page.waitForSelector("#relief-view[hidden]");
  await page.close();
});
