// What clicks and keys on the map itself do.

import { roundedPlace } from "./dragging.js";
import { candidateAt } from "./search_layer.js";
import { element } from "../panel/elements.js";
import { moveSite } from "../state/plan.js";
import { addTurbine } from "../state/turbines.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../state/scene.js").Place} Place */
/** @typedef {import("../vendor/ol.js").OlMap} OlMap */
/** @typedef {import("./markers.js").Markers} Markers */

/** Adds what the task is about. @param {Scene} scene @param {Markers} masts @param {Markers} turbines
 * @param {Place} place */
function add(scene, masts, turbines, place) {
  const { task } = scene.state;
  if (task === "turbines") {
    addTurbine(scene, place);
    turbines.focus(scene.state.turbine ?? -1);
  } else if (task !== "sites") {
    scene.addMast(place);
    masts.focus(scene.state.selected ?? -1);
  }
}

/** @param {Scene} scene @param {number[]} coordinate */
const roundedAt = ({ cell }, [x, y]) => roundedPlace({ x, y }, cell);

/** @param {Scene} scene @param {OlMap} map @param {number[]} coordinate @param {(place: Place) => void} addHere */
function click(scene, map, coordinate, addHere) {
  const { task, placing, turbines, plan } = scene.state;
  const place = roundedAt(scene, coordinate);
  if (task === "sites") {
    const candidate = candidateAt(scene, map, coordinate);
    if (plan && candidate) moveSite(scene, plan.selected, candidate);
  } else if (placing || (task === "turbines" ? turbines.length === 0 : !scene.mast)) {
    addHere(place);
  } else {
    scene.change(task === "turbines" ? { viewpoint: place } : { target: place });
  }
}

/** Clicks place masts and turbines, or the far end of a line of sight or a wireline, or take a candidate; Enter on the
 * map takes its middle, Escape gives up.
 * @param {Scene} scene @param {OlMap} map @param {Markers} masts @param {Markers} turbines */
export function takeClicks(scene, map, masts, turbines) {
  const addHere = (/** @type {Place} */ place) => add(scene, masts, turbines, place);
  map.on("click", ({ coordinate }) => click(scene, map, coordinate, addHere));
  map.getViewport().addEventListener("contextmenu", (event) => {
    event.preventDefault();
    addHere(roundedAt(scene, map.getEventCoordinate(event)));
  });
  element("map").addEventListener("keydown", (event) => {
    if (event.key === "Enter" && event.target === element("map")) {
      addHere(roundedAt(scene, map.getView().getCenter() ?? [0, 0]));
    }
  });
  document.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    scene.change(scene.state.placing ? { placing: false } : { target: null, viewpoint: null });
  });
}
