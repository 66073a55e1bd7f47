// Where sites are looked for: in an area that is drawn, or among places of a file.

import { element } from "../panel/elements.js";
import { areaText, countedText } from "../panel/words.js";
import { roundUp } from "../state/first_state.js";
import { areaOf, haveHeights } from "../state/plan.js";
import { drawArea } from "../map/search_layer.js";
import { ringInView } from "./served_form.js";
import { onTyped } from "../panel/typed.js";
import { takeFiles, warningsOf } from "./tasks_form.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../state/plan.js").Search} Search */
/** @typedef {import("../vendor/ol.js").OlMap} OlMap */

/** So many candidates to a side of an area. */
const CANDIDATES_ACROSS = 10;

/** @param {Search} search */
const areaIn = (search) =>
  ("ring" in search ? [search.ring] : search.rings).reduce((sum, ring) => sum + areaOf(ring), 0);

/** What is looked through, in words. @param {Search | null} search */
function searchText(search) {
  if (!search) return "Draw an area, take all that is in view, or load places (CSV) or an area (GeoJSON).";
  const area = areaIn(search);
  if ("ring" in search) return `Candidates are proposed in ${areaText(area)}.`;
  if (search.places.length > 0) return `${countedText(search.places.length, "candidate")} of ${search.file}.`;
  return `Candidates are proposed in ${areaText(area)}, the area of ${search.file}.`;
}

/** A round distance between candidates that suits the area. @param {Search} search */
export const usualSpacing = (search) => roundUp(Math.sqrt(areaIn(search)) / CANDIDATES_ACROSS);

/** Returns what takes a file with places or an area. @param {Scene} scene @param {OlMap} map
 * @param {import("../server/api.js").Jobs} jobs @param {import("../server/api.js").Info} info
 * @param {string} gone  Says of a file of the page's address that it is not there any more; else empty. */
export function makeSearchForm(scene, map, jobs, info, gone) {
  const take = (/** @type {Search} */ search) => {
    const { siting } = scene.state;
    const spacing = areaIn(search) > 0 ? String(usualSpacing(search)) : siting.spacing;
    scene.change({ search, plan: null, siting: { ...siting, spacing } });
  };
  makeDrawing(scene, map, (ring) => {
    if (scene.state.drawing === "search") take({ ring });
    else scene.change({ served: { kind: "area", ring }, plan: null });
  });
  element("area-in-view").addEventListener("click", () => {
    const ring = ringInView(map, info);
    if (ring) take({ ring });
  });
  const takePlaces = takeFiles("candidates", element("candidates-problem"), async (file) => {
    const upload = await jobs.send(file.name, file);
    const { name, places, rings } = upload;
    if (places.length === 0 && rings.length === 0) throw new Error(`${file.name}: has neither places nor an area`);
    take({ file: file.name, upload: name, places, rings });
    element("candidates-problem").textContent = warningsOf(upload);
  });
  element("candidates-problem").textContent = gone;
  scene.on(["search"], () => {
    const { search } = scene.state;
    element("search-said").textContent = searchText(search);
    element("spacing-field").hidden = search === null || areaIn(search) === 0;
    element("height-field").hidden = haveHeights(search);
  });
  makeSitingFields(scene);
  return takePlaces;
}

/** How many sites, how high, how far apart. @param {Scene} scene */
function makeSitingFields(scene) {
  for (const name of /** @type {const} */ (["count", "height", "spacing"])) {
    const field = /** @type {HTMLInputElement} */ (element(`site-${name}`));
    onTyped(field, () => scene.change({ siting: { ...scene.state.siting, [name]: field.value.trim() } }));
    scene.on(["siting"], () => {
      if (field.value.trim() !== scene.state.siting[name]) field.value = scene.state.siting[name];
    });
  }
}

/** @param {Scene} scene @param {OlMap} map @param {(ring: number[]) => void} take */
function makeDrawing(scene, map, take) {
  /** @type {(() => void) | null} */
  let stop = null;
  const end = () => scene.change({ placing: false });
  const buttons = /** @type {const} */ ([
    [element("area-button"), "search"],
    [element("served-button"), "served"],
  ]);
  for (const [button, what] of buttons) {
    button.addEventListener("click", () => {
      const { placing, drawing } = scene.state;
      scene.change({ placing: !(placing && drawing === what), drawing: what });
    });
  }
  scene.on(["placing", "drawing", "task"], () => {
    const { task, placing, drawing } = scene.state;
    const active = task === "sites" && placing;
    for (const [button, what] of buttons) button.setAttribute("aria-pressed", String(active && drawing === what));
    element("map").classList.toggle("drawing", active);
    if (active === (stop !== null)) return;
    stop?.();
    stop = active ? drawArea(map, take, end) : null;
  });
}
