// What clicks and keys on the map itself do.

import { roundedPlace } from "./dragging.js";
import { element } from "../panel/elements.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../vendor/ol.js").OlMap} OlMap */

/** Clicks place masts, or the far end of the line of sight; Enter on the map takes its middle, Escape gives up.
 * @param {Scene} scene @param {OlMap} map @param {(id: number) => void} focusMast */
export function takeClicks(scene, map, focusMast) {
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
