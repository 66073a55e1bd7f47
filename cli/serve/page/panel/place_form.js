// Where the next mast goes: a click on the map, or a place that is typed.

import { element } from "./elements.js";
import { askPlace } from "../server/api.js";
import { roundedPlace } from "../map/dragging.js";
import { MOST_MASTS } from "../state/scene.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../vendor/ol.js").OlMap} OlMap */

/** @param {Scene} scene @param {OlMap} map @param {(id: number) => void} focusMast */
export function makePlaceForm(scene, map, focusMast) {
  const form = /** @type {HTMLFormElement} */ (element("place-form"));
  const input = /** @type {HTMLInputElement} */ (element("place"));
  const problem = element("place-problem");
  const button = /** @type {HTMLButtonElement} */ (element("place-button"));
  button.addEventListener("click", () => scene.change({ placing: !scene.state.placing }));
  form.addEventListener("submit", async (event) => {
    event.preventDefault();
    problem.textContent = "";
    try {
      const place = await askPlace(input.value);
      scene.addMast(place);
      showPlace(map, place);
      input.value = "";
    } catch (error) {
      problem.textContent = error instanceof Error ? error.message : String(error);
    }
  });
  scene.on(["placing", "masts"], () => {
    const { placing, masts } = scene.state;
    button.setAttribute("aria-pressed", String(placing));
    button.disabled = masts.length >= MOST_MASTS;
    element("map").classList.toggle("placing", placing || masts.length === 0);
    element("hint").hidden = !placing && masts.length > 0;
  });
  takeClicks(scene, map, focusMast);
}

/** Clicks place masts, or the far end of the line of sight; Enter on the map takes its middle, Escape gives up.
 * @param {Scene} scene @param {OlMap} map @param {(id: number) => void} focusMast */
function takeClicks(scene, map, focusMast) {
  const cell = () => Number(scene.state.options.cell) || 1;
  const add = (/** @type {number[]} */ [x, y]) => {
    scene.addMast(roundedPlace({ x, y }, cell()));
    if (scene.state.selected !== null) focusMast(scene.state.selected);
  };
  map.on("click", ({ coordinate: [x, y] }) => {
    if (scene.state.placing || !scene.mast) add([x, y]);
    else scene.change({ target: roundedPlace({ x, y }, cell()) });
  });
  map.getViewport().addEventListener("contextmenu", (event) => {
    event.preventDefault();
    add(map.getEventCoordinate(event));
  });
  element("map").addEventListener("keydown", (event) => {
    if (event.key === "Enter" && event.target === element("map")) add(map.getView().getCenter() ?? [0, 0]);
  });
  document.addEventListener("keydown", (event) => {
    if (event.key === "Escape") scene.change(scene.state.placing ? { placing: false } : { target: null });
  });
}

/** Brings a place into view. @param {OlMap} map @param {{x: number, y: number}} place */
function showPlace(map, { x, y }) {
  const [west, south, east, north] = map.getView().calculateExtent();
  if (x < west || x > east || y < south || y > north) map.getView().animate({ center: [x, y], duration: 200 });
}
