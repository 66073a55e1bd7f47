// A single place on the map that the planner has chosen: a button that is dragged or moved with the arrow keys.

import { Overlay } from "../vendor/ol.js";
import { follow } from "./dragging.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../state/scene.js").SceneState} SceneState */
/** @typedef {import("../state/scene.js").Place} Place */
/**
 * @typedef {object} PlaceKind
 * @property {string} className
 * @property {string} label  What the place is, for those who hear it.
 * @property {"target" | "viewpoint"} name  What of the scene's state has the place.
 * @property {(keyof SceneState)[]} keys   What the marker follows.
 * @property {() => Place | null} shown    The place, where the marker is to be seen.
 */

/** @param {import("../vendor/ol.js").OlMap} map @param {Scene} scene @param {PlaceKind} kind */
export function makePlaceMarker(map, scene, { className, label, name, keys, shown }) {
  const button = document.createElement("button");
  button.type = "button";
  button.className = className;
  button.setAttribute("aria-label", `${label}. Arrow keys move it, Delete removes it.`);
  const marker = new Overlay({ element: button, positioning: "center-center", stopEvent: true });
  map.addOverlay(marker);
  follow(map, button, {
    place: shown,
    cell: () => scene.cell,
    move: (to) => scene.change({ [name]: to }),
    remove: () => scene.change({ [name]: null }),
  });
  scene.on(keys, () => {
    const at = shown();
    marker.setPosition(at ? [at.x, at.y] : undefined);
  });
}
