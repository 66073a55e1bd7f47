// What is written of wind turbines: the zone of visibility as files, and the wireline from a place on the map.

import { keepingPlace } from "../map/keeping_place.js";
import { element } from "../panel/elements.js";
import { placeText } from "../panel/words.js";
import { jobOptions } from "./job_options.js";
import { JobRun } from "./job_run.js";
import { tableOf, turbineTable } from "./tables.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../state/scene.js").Place} Place */
/** @typedef {import("../server/api.js").Jobs} Jobs */

const ZONE = "zone";
const WIRELINE = "wireline";
/** A wireline needs no cells: few of them take no time. */
const FEW_CELLS = 10;
/** @param {string} name */
const isWireline = (name) => /wireline-[^/]*\.(pdf|png|svg)$/.test(name);
/** A drag is followed once it rests. */
const REST = 250;

/** @param {Scene} scene @param {Jobs} jobs */
export function makeZoneFiles(scene, jobs) {
  const button = /** @type {HTMLButtonElement} */ (element("write-zone"));
  const sheets = /** @type {HTMLInputElement} */ (element("zone-sheets"));
  const run = new JobRun(element("zone-run"), jobs, "Writing the zone of visibility");
  button.addEventListener("click", () =>
    run.run(async () => {
      const { name } = await jobs.send("turbines.csv", turbineTable(scene.state.turbines));
      const options = { ...jobOptions("ztv", scene.state.options), turbines: name, output: ZONE };
      return { verb: "ztv", options: { ...options, ...(sheets.checked ? { sheets: "A3" } : {}) }, uploads: [name] };
    }),
  );
  run.follow(scene, ["turbines", "options"], () => [
    scene.state.turbines,
    jobOptions("ztv", scene.state.options),
    sheets.checked,
  ]);
  sheets.addEventListener("change", () => run.compare());
  scene.on(["turbines"], () => (button.disabled = scene.state.turbines.length === 0));
}

/** @param {Scene} scene @param {Place} from @param {Jobs} jobs */
async function wirelineCall({ state: { turbines, options } }, from, jobs) {
  const layout = await jobs.send("turbines.csv", turbineTable(turbines));
  const eyes = await jobs.send("viewpoints.csv", tableOf(["name", "x", "y"], [["Viewpoint", from.x, from.y]]));
  const farthest = Math.max(...turbines.map(({ x, y }) => Math.hypot(x - from.x, y - from.y)));
  const radius = Math.max(Number(options.radius) || 0, Math.ceil(1.01 * farthest));
  return {
    verb: "ztv",
    options: {
      ...jobOptions("ztv", options),
      ...{ turbines: layout.name, viewpoints: eyes.name, output: WIRELINE },
      ...{ radius: String(radius), cell: String(Math.ceil(radius / FEW_CELLS)), "wireline-hidden": "true" },
    },
    uploads: [layout.name, eyes.name],
  };
}

/** Shows what an eye at the viewpoint sees of the turbines, anew as either moves.
 * @param {Scene} scene @param {Jobs} jobs @param {import("../vendor/ol.js").OlMap} map */
export function makeWireline(scene, jobs, map) {
  const panel = element("wireline");
  const said = element("wireline-said");
  const picture = /** @type {HTMLImageElement} */ (element("wireline-picture"));
  const run = new JobRun(element("wireline-run"), jobs, "Drawing the wireline", isWireline);
  let asked = "";
  let resting = 0;
  element("wireline-close").addEventListener("click", () => scene.change({ viewpoint: null }));
  const draw = async (/** @type {Place} */ from) => {
    said.textContent = `Wireline from ${placeText(from.x, from.y)}`;
    const job = await run.run(() => wirelineCall(scene, from, jobs));
    const file = job?.files.find(({ name }) => name.endsWith(".svg"));
    picture.hidden = !file;
    if (!file) return;
    picture.src = file.url;
    picture.alt = `What is seen of the turbines from ${placeText(from.x, from.y)}`;
  };
  scene.on(["viewpoint", "turbines", "task", "options"], () => {
    const { viewpoint, turbines, task, options } = scene.state;
    const from = task === "turbines" && turbines.length > 0 ? viewpoint : null;
    keepingPlace(map, from, () => (panel.hidden = !from));
    const wanted = from ? JSON.stringify([from, turbines, options]) : "";
    if (wanted === asked) return;
    asked = wanted;
    clearTimeout(resting);
    if (from) resting = setTimeout(() => draw(from), REST);
    else run.cancel();
  });
}
