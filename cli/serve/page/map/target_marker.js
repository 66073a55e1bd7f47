// The far end of the line of sight on the map, which can be dragged and moved with the arrow keys.

import { Overlay } from "../vendor/ol.js";
import { follow } from "./dragging.js";

/** @typedef {import("../state/scene.js").Scene} Scene */

/** @param {import("../vendor/ol.js").OlMap} map @param {Scene} scene */
export function makeTargetMarker(map, scene) {
  const button = document.createElement("button");
  button.type = "button";
  button.className = "target";
  button.setAttribute("aria-label", "Far end of the line of sight. Arrow keys move it, Delete removes it.");
  const marker = new Overlay({ element: button, positioning: "center-center", stopEvent: true });
  map.addOverlay(marker);
  follow(map, button, {
    place: () => scene.farEnd,
    cell: () => Number(scene.state.options.cell) || 1,
    move: (target) => scene.change({ target }),
    remove: () => scene.change({ target: null }),
  });
  scene.on(["target", "masts", "selected"], () => {
    const end = scene.farEnd;
    marker.setPosition(end && !end.name ? [end.x, end.y] : undefined);
  });
}
