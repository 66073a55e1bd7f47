// What sites are to serve: chosen and said before they are looked for.

import { element } from "../panel/elements.js";
import { areaText, chosenText, countedText } from "../panel/words.js";
import { areaOf } from "../state/plan.js";
import { cellsIn, placesServed, servedOf } from "../state/served.js";
import { tableOf } from "./tables.js";
import { hasBuildings, takeFiles, warningsOf } from "./tasks_form.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../state/served.js").Served} Served */
/** @typedef {import("../vendor/ol.js").OlMap} OlMap */
/** @typedef {import("../server/api.js").Info} Info */
/** @typedef {import("../server/api.js").Jobs} Jobs */
/** @typedef {import("../state/plan.js").Asked} Asked */

/** The ground that is in view, as far as there are data. @param {OlMap} map @param {Info} info */
export function ringInView(map, info) {
  const [west, south, east, north] = map.getView().calculateExtent();
  const { xmin, ymin, xmax, ymax } = info.bounds;
  const [w, s] = [Math.max(west, xmin), Math.max(south, ymin)].map(Math.ceil);
  const [e, n] = [Math.min(east, xmax), Math.min(north, ymax)].map(Math.floor);
  return w < e && s < n ? [w, s, e, s, e, n, w, n] : null;
}

/** @param {Scene} scene @param {OlMap} map @param {Info} info @returns {string} */
function servedText({ state: { served, options } }, map, info) {
  switch (served.kind) {
    case "view": {
      const ring = ringInView(map, info);
      return ring
        ? `To be served: ${areaText(areaOf(ring))} of ground, all that is in view when you choose sites.`
        : "";
    }
    case "area":
      return served.ring
        ? `To be served: the ${areaText(areaOf(served.ring))} of ground in the area drawn.`
        : "Draw the area that is to be served.";
    case "places":
      return served.upload
        ? `To be served: the ${countedText(served.rows, "place")} of ${served.file}.`
        : "Load the households or other places that are to be served (CSV with columns x,y or lon,lat, or GeoJSON).";
    case "premises":
      return `To be served: the buildings within ${chosenText(Number(options.radius))} of a candidate, on their walls or roofs.`;
    default:
      return `To be served: all ground within ${chosenText(Number(options.radius))} of a candidate.`;
  }
}

/** @param {Scene} scene @param {OlMap} map @param {Jobs} jobs @param {Info} info
 * @param {string} gone  Says of a file of the page's address that it is not there any more; else empty. */
export function makeServedForm(scene, map, jobs, info, gone) {
  const select = /** @type {HTMLSelectElement} */ (element("served"));
  if (!hasBuildings(info)) select.querySelector("option[value=premises]")?.remove();
  const change = (/** @type {Served} */ served) => scene.change({ served, plan: null });
  select.addEventListener("change", () => change(servedOf(/** @type {any} */ (select.value))));
  takeFiles("served-places", element("served-problem"), async (file) => {
    const upload = await jobs.send(file.name, file);
    if (upload.places.length === 0) throw new Error(`${file.name}: has no places`);
    change(placesServed(file.name, upload));
    element("served-problem").textContent = warningsOf(upload);
  });
  element("served-problem").textContent = gone;
  scene.on(["served", "options", "view", "task"], () => {
    const { served } = scene.state;
    select.value = served.kind;
    element("served-button").hidden = served.kind !== "area";
    element("served-file").hidden = served.kind !== "places";
    element("served-said").textContent = servedText(scene, map, info);
  });
}

/** What the page says of the result of a call. @param {Served} served @param {number} radius @returns {Asked} */
export function askedOf(served, radius) {
  switch (served.kind) {
    case "premises":
      return { what: "the buildings within reach", unit: "building" };
    case "places":
      return { what: `the places of ${served.file}`, unit: "place" };
    case "reach":
      return { what: `what lies within ${chosenText(radius)} of a candidate`, unit: "ground" };
    default:
      return { what: served.kind === "view" ? "the ground that was in view" : "the area drawn", unit: "ground" };
  }
}

/** What a call of `itin site` is told of it.
 * @param {Scene} scene @param {OlMap} map @param {Info} info @param {Jobs} jobs
 * @returns {Promise<{options: Record<string, string>, uploads: string[]}>} */
export async function servedCall(scene, map, info, jobs) {
  const { served } = scene.state;
  if (served.kind === "premises") return { options: { demand: "premises" }, uploads: [] };
  if (served.kind === "places") {
    if (!served.upload) throw new Error("Load the places that are to be served.");
    return { options: { demand: served.upload }, uploads: [] };
  }
  if (served.kind === "reach") return { options: {}, uploads: [] };
  const ring = served.kind === "view" ? ringInView(map, info) : served.ring;
  if (!ring) {
    throw new Error(served.kind === "view" ? "There is no ground in view." : "Draw the area that is to be served.");
  }
  const points = cellsIn(ring, scene.cell);
  if (points.length === 0) {
    throw new Error("No middle of a cell lies in the area that is to be served: draw a larger one.");
  }
  const { name } = await jobs.send(
    "served.csv",
    tableOf(
      ["x", "y"],
      points.map(({ x, y }) => [x, y]),
    ),
  );
  return { options: { demand: name }, uploads: [name] };
}
