// Tests of what outlives the page: its address, the command, files; and of a server that goes.
import assert from "node:assert/strict";
import { copyFileSync, mkdirSync, renameSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

import { closed, downloaded, mastAt, pageWithMast, setField, settled, text, until, value, MIDDLE } from "./planner.mjs";
import { keepPicture, openPage, runLine, serve, world } from "./served_map.mjs";

/** The page's address, once it is that of what the map shows. */
async function stillAddress(page) {
  let last = "";
  return until(async () => {
    const before = last;
    last = page.url();
    await new Promise((resume) => setTimeout(resume, 500));
    return before === last && last === page.url() && last;
  }, "the address stands still");
}

test("a reload from the address shows the same, and the key is not in it", async () => {
  const page = await pageWithMast();
  await page.mouse.click(MIDDLE.x + 90, MIDDLE.y - 60);
  await setField(page, "[name=effective-earth]", "4/3");
  await settled(page);
  await page.waitForFunction(() => location.hash.includes("effective-earth=4/3") && location.hash.includes("&target="));
  await page.waitForSelector("#line[aria-busy=false]");
  const address = await stillAddress(page);
  const mast = await mastAt(page);
  const said = await text(page, "#line-verdict");
  assert.doesNotMatch(address, /key=/);
  await closed(page);
  const again = await openPage(world.browser, address);
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
  const folder = join(world.folder, "downloads");
  const client = await page.createCDPSession();
  await client.send("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: folder });
  await world.browser
    .defaultBrowserContext()
    .overridePermissions(new URL(world.hills.address).origin, [
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
  assert.deepEqual(await downloaded(folder, "mast-a.tif"), runLine(command, world.folder, "by-hand.tif"));
  await page.waitForFunction(() => document.querySelector("#results-said").textContent.startsWith("Saved"));
  await page.$eval("[data-ending=png]", (button) => button.click());
  assert.equal((await downloaded(folder, "mast-a.png")).subarray(1, 4).toString(), "PNG");
  await closed(page);
});

test("a file that takes too long is cancelled", async () => {
  const page = await pageWithMast();
  await setField(page, "[name=cell]", "25");
  await settled(page);
  await page.$eval("[data-ending=pdf]", (button) => button.click());
  await page.waitForSelector("#job:not([hidden])");
  await page.$eval("#job-cancel", (button) => button.click());
  await page.waitForSelector("#job[hidden]");
  assert.equal(await text(page, "#results-said"), "");
  await closed(page);
});

test("the page says when the server has gone, and goes on with the address of the next one", async () => {
  const first = await serve(world.folder, "hills.itin");
  const page = await pageWithMast(first);
  const says = (words) =>
    page.waitForFunction((wanted) => document.querySelector("#status").textContent.includes(wanted), {}, words);
  await first.stop();
  await says("does not answer");
  const second = await serve(world.folder, "hills.itin", new URL(first.address).port);
  await says("no key to the server");
  const place = await mastAt(page);
  await page.evaluate((address) => {
    document.body.id = "before";
    location.href = address;
  }, second.address);
  await page.waitForSelector("body:not(#before) .mast.selected");
  assert.deepEqual(await mastAt(page), place);
  await settled(page);
  await page.close();
  await second.stop();
});

test("a store that is gone is told of in one line, and the map goes on when it is back", async () => {
  const [store, away] = ["passing.itin", "away.itin"].map((name) => join(world.folder, name));
  copyFileSync(join(world.folder, "hills.itin"), store);
  const server = await serve(world.folder, "passing.itin");
  const page = await pageWithMast(server);
  renameSync(store, away);
  await page.focus(".marker");
  await page.keyboard.press("ArrowLeft");
  const status = () => text(page, "#status");
  await until(async () => /^passing\.itin: is no longer there/.test(await status()), "the page says so");
  await keepPicture(page, "gone");
  renameSync(away, store);
  await page.keyboard.press("ArrowLeft");
  await settled(page);
  await until(() => page.$eval("#status", (line) => line.hidden), "the line goes");
  await page.close();
  await server.stop();
});

test("without the key the page says where to find it", async () => {
  const context = await world.browser.createBrowserContext();
  const page = await context.newPage();
  await page.goto(new URL(world.hills.address).origin);
  await page.waitForFunction(() => document.querySelector("#status").textContent.includes("itin serve printed"));
  await context.close();
});
