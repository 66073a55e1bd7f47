// The figures of the live map: from the hand to the picture, in Chromium. benchmarks/live/all runs it.
import { readFileSync } from "node:fs";
import { loadavg } from "node:os";
import { basename, dirname } from "node:path";
import { parseArgs } from "node:util";

import { launchBrowser, openPage, serve } from "../../tests/live/served_map.mjs";
import { installProbe } from "./probe.mjs";
import { SCENES, storeOf } from "./scenes.mjs";

const { only, moves: given } = parseArgs({
  options: { only: { type: "string", default: "" }, moves: { type: "string", default: "60" } },
}).values;
const MOVES = Number(given);
const BETWEEN_MOVES = 1000 / 30;
const STEP = 2; // pixels
const WIDTH = 1200;
const HEIGHT = 900;
const MEMORY = 1 << 30;
const IDLE = 0.3;

const pause = (milliseconds) => new Promise((resume) => setTimeout(resume, milliseconds));

/** The value that a share of all values does not pass. */
const quantile = (values, share) => {
  const sorted = values.filter(Number.isFinite).sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] ?? NaN;
};
const both = (values) => `${quantile(values, 0.5).toFixed(0)}, ${quantile(values, 0.95).toFixed(0)}`;

/** Milliseconds of processor time of a process so far. */
function processorOf(pid) {
  const fields = readFileSync(`/proc/${pid}/stat`, "utf8").split(") ")[1].split(" ");
  return 10 * (Number(fields[11]) + Number(fields[12]));
}
const peakOf = (pid) => 1024 * Number(readFileSync(`/proc/${pid}/status`, "utf8").match(/VmHWM:\s+(\d+)/)[1]);

const addressOf = (server, { x, y, radius, cell }) => {
  const resolution = (2.2 * radius) / HEIGHT;
  const scene = `mast=${x},${y},20,0,Mast&radius=${radius}&cell=${cell}&target-height=2&at=${x},${y},${resolution}`;
  return `${server.address}&${scene}`;
};

async function pageOf(browser, address) {
  const page = await openPage(browser, address, { width: WIDTH, height: HEIGHT, before: installProbe });
  await page.bringToFront();
  return page;
}

const settled = (page) => page.waitForFunction(() => window.figures.settled(), { timeout: 60000, polling: 20 });
const take = (page) => page.evaluate(() => window.figures.take());

/** Drags the mast to and fro, and calls after each move. */
async function drag(page, moves, afterMove) {
  const { x, y } = await page.$eval(".marker", (marker) => {
    const box = marker.getBoundingClientRect();
    return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  });
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let i = 1; i <= moves; ++i) {
    const away = i <= moves / 2 ? i : moves - i;
    await page.mouse.move(x + STEP * away, y + (i % 2) * STEP);
    await afterMove();
  }
  await page.mouse.up();
}

async function measure(browser, scene, store) {
  const server = await serve(dirname(store), basename(store));
  try {
    const page = await pageOf(browser, addressOf(server, scene));
    await settled(page);
    const { moves: opening } = await take(page);
    const answer = opening.map(({ firstDrawn, sent }) => firstDrawn - sent);

    const before = processorOf(server.pid);
    await drag(page, MOVES, () => settled(page));
    const { moves: single } = await take(page);
    const processor = (processorOf(server.pid) - before) / MOVES;

    await drag(page, MOVES, () => pause(BETWEEN_MOVES));
    await settled(page);
    const { moves: steady } = await take(page);
    // The page need not send each of them.
    const painted = (100 * steady.filter(({ firstDrawn }) => firstDrawn !== undefined).length) / MOVES;

    for (let i = 0; i < MOVES; ++i) {
      await page.mouse.move(WIDTH / 2 + 3 * i, HEIGHT / 4 + i);
      await pause(50);
    }
    await page.waitForFunction(() => window.figures.probed(), { polling: 20 });
    const { probes } = await take(page);
    const since = (name) => single.map((move) => move[name] - move.input);
    await page.close();
    return {
      first: since("firstDrawn"),
      ninth: since("ninthDrawn"),
      all: since("allDrawn"),
      steady: steady.map(({ firstDrawn, input }) => firstDrawn - input),
      probe: probes.map(({ drawn, input }) => drawn - input),
      ...{ answer, painted, processor },
    };
  } finally {
    await server.stop();
  }
}

/** How long the browser waits for tiles of heights that nobody has asked for yet. */
async function tileTimes(browser, store) {
  const server = await serve(dirname(store), basename(store));
  const page = await openPage(browser, server.address);
  const times = await page.evaluate(async () => {
    const { tiles, version } = await (await fetch("/api/v1/info")).json();
    const found = [];
    for (let z = 0; z < tiles.resolutions.length; ++z) {
      for (let k = 0; k < 8; ++k) {
        const begin = performance.now();
        const answer = await fetch(
          `/tiles/heights/${z}/${k % 2 ** z}/${(3 * k) % 2 ** z}?v=${version}&again=${z},${k}`,
        );
        await answer.arrayBuffer();
        if (answer.status === 200) found.push(performance.now() - begin);
      }
    }
    return found;
  });
  await page.close();
  await server.stop();
  return times;
}

/** The most memory of a server that shows ten maps. */
async function tenMaps(browser, scene, store) {
  const server = await serve(dirname(store), basename(store));
  const pages = [];
  for (let i = 0; i < 10; ++i) {
    const moved = { ...scene, x: scene.x + 0.3 * scene.radius * (i - 5), y: scene.y + 0.2 * scene.radius * (5 - i) };
    pages.push(await pageOf(browser, addressOf(server, moved)));
    await settled(pages.at(-1));
  }
  const peak = peakOf(server.pid);
  await Promise.all(pages.map((page) => page.close()));
  await server.stop();
  return peak;
}

const mark = (met) => (met ? "" : " (missed)");
const judged = (values, aim) => `${both(values)}${mark(quantile(values, 0.95) <= aim)}`;

function row({ name, aims }, found) {
  const cells = [
    name,
    judged(found.first, aims.first),
    judged(found.ninth, aims.ninth),
    judged(found.all, aims.all),
    found.processor.toFixed(0),
    `${found.painted.toFixed(0)} %${mark(found.painted >= (aims.painted ?? 0))}`,
    both(found.steady),
    `${quantile(found.answer, 0.5).toFixed(0)}${mark(quantile(found.answer, 0.5) <= aims.answer)}`,
    judged(found.probe, 10),
  ];
  return `| ${cells.join(" | ")} |`;
}

const HEAD = [
  ["cells in view", "first colour", "1 in 9", "all", "processor", "moves painted", "first colour meanwhile"],
  ["first answer", "under the cursor"],
].flat();

const browser = await launchBrowser();
console.log(`load before: ${loadavg()[0].toFixed(2)}${loadavg()[0] > IDLE ? ": the machine is not idle" : ""}`);
console.log("Milliseconds by the clock, median and 95 %; processor: of the server, for each move.\n");
console.log(`| ${HEAD.join(" | ")} |\n|${HEAD.map(() => "---|").join("")}`);
for (const scene of SCENES.filter(({ name }) => name.includes(only))) {
  const store = storeOf(scene.store);
  console.log(
    store ? row(scene, await measure(browser, scene, store)) : `left out: ${scene.name}, of which there is no data`,
  );
}
const [scene] = SCENES;
const store = storeOf(scene.store);
const times = await tileTimes(browser, store);
const peak = await tenMaps(browser, scene, store);
console.log(`\na tile of heights: ${judged(times, 20)} ms`);
console.log(`ten maps: ${(peak / 2 ** 20).toFixed(0)} MB${mark(peak <= MEMORY + (64 << 20))}, with --memory 1G`);
console.log(`load after: ${loadavg()[0].toFixed(2)}`);
await browser.close();
