// The map as a planner has it: the program serves a store, and Chromium opens the address that it prints.
import { execFileSync, execSync, spawn } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";

const packages = createRequire(new URL("../../build/web/package.json", import.meta.url));
const puppeteer = packages("puppeteer-core");
export const axeSource = packages("axe-core").source;

const program = process.env.ITIN_PROGRAM ?? new URL("../../build/test/bin/itin", import.meta.url).pathname;
const data = new URL("../../scripts/demo-data/", import.meta.url).pathname;
const pictures = new URL("../../build/live/", import.meta.url).pathname;

/** How long tests wait for what must come, in milliseconds: the machine may be busy. */
export const PATIENCE = 300000;

/** Runs the program in a folder, with a list of options or a line of some that have no spaces, and returns what it
 * prints. */
export const itin = (options, folder) =>
  execFileSync(program, Array.isArray(options) ? options : options.split(" "), {
    cwd: folder,
    encoding: "utf8",
    stdio: ["ignore", "pipe", "ignore"],
  });

/** Runs a line that someone copied into a shell, in a folder, and returns the file that it writes. */
export function runLine(line, folder, output) {
  const env = { ...process.env, PATH: `${dirname(program)}:${process.env.PATH}` };
  execSync(`${line.replace(/ -o \S+/, "")} -o ${output}`, { cwd: folder, env, stdio: "ignore" });
  return readFileSync(join(folder, output));
}

/** What tests share: a folder with the demonstration's hills and a town with houses, a server of each, a browser. */
export const world = {};

export async function startWorld() {
  const folder = mkdtempSync(join(tmpdir(), "itin-live-"));
  itin(`import hills.itin ${data}cardiff.tif`, folder);
  itin(`import town.itin ${data}alexandria-dtm.tif`, folder);
  itin(`import town.itin ${data}alexandria-buildings.geojson --kind buildings --height-field HEIGHT`, folder);
  const started = [serve(folder, "hills.itin"), serve(folder, "town.itin"), launchBrowser()];
  const [hills, town, browser] = await Promise.all(started);
  Object.assign(world, { folder, hills, town, browser });
}

export async function stopWorld() {
  await world.browser?.close();
  await Promise.all(Array.from(servers, (stop) => stop()));
  if (world.folder) rmSync(world.folder, { recursive: true });
}

function freePort() {
  return new Promise((resolve) => {
    const server = createServer().listen(0, "127.0.0.1", () => {
      const { port } = server.address();
      server.close(() => resolve(port));
    });
  });
}

/** Servers that run: a test that fails does not stop its own, and the run would wait for it. */
const servers = new Set();

/** Serves a store of the folder until it is stopped. */
export async function serve(folder, store, port) {
  const child = spawn(program, ["serve", store, "--port", String(port ?? (await freePort()))], {
    cwd: folder,
    stdio: ["ignore", "pipe", "pipe"],
  });
  const address = await new Promise((resolve, reject) => {
    let said = "";
    const listen = (chunk) => {
      said += chunk;
      const found = said.match(/http:\S+#key=\S+/);
      if (found) resolve(found[0]);
    };
    child.stdout.on("data", listen);
    child.stderr.on("data", listen);
    child.on("exit", () => reject(new Error(`itin serve ended: ${said}`)));
  });
  const ended = new Promise((resolve) => child.on("exit", resolve));
  const stop = () => (servers.delete(stop), child.kill("SIGINT"), ended);
  servers.add(stop);
  return { address, pid: child.pid, stop };
}

/** Starts Chromium; `drawing` are arguments that say how it draws. */
export const launchBrowser = (drawing = ["--disable-gpu"]) =>
  puppeteer.launch({
    executablePath: process.env.ITIN_CHROMIUM ?? "/usr/bin/chromium",
    headless: true,
    timeout: PATIENCE,
    protocolTimeout: PATIENCE,
    args: ["--no-sandbox", "--force-device-scale-factor=1", ...drawing],
  });

/** Opens an address, where `before` runs before the page's own modules, and notes errors of the page and requests to other places than the server. */
export async function openPage(browser, address, { width = 1200, height = 800, dark = false, before } = {}) {
  const page = await browser.newPage();
  page.setDefaultTimeout(PATIENCE);
  if (before) await page.evaluateOnNewDocument(before);
  const origin = new URL(address).origin;
  const troubles = [];
  page.on("pageerror", (problem) => troubles.push(problem.message));
  page.on("request", (request) => {
    if (!/^(data|blob):/.test(request.url()) && new URL(request.url()).origin !== origin) {
      troubles.push(`request to ${request.url()}`);
    }
  });
  page.on("console", (message) => message.type() === "error" && troubles.push(message.text()));
  await page.setViewport({ width, height, isMobile: width < 600, hasTouch: width < 600 });
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: dark ? "dark" : "light" }]);
  await page.goto(address);
  await page.waitForSelector("#map .ol-layer canvas");
  return Object.assign(page, { troubles });
}

/** Keeps a picture of the page in build/live, to be looked at. */
export async function keepPicture(page, name) {
  mkdirSync(pictures, { recursive: true });
  return page.screenshot({ path: join(pictures, `${name}.png`) });
}
