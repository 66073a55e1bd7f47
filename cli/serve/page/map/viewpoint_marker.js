// The place on the map from which a wireline is seen. It can be dragged and moved with the arrow keys.

import { Overlay } from "../vendor/ol.js";
import { follow } from "./dragging.js";

/** @typedef {import("../state/scene.js").Scene} Scene */

/** @param {import("../vendor/ol.js").OlMap} map @param {Scene} scene */
export function makeViewpointMarker(map, scene) {
  const button = document.createElement("button");
  button.type = "button";
  button.className = "eye";
  button.setAttribute("aria-label", "Viewpoint of the wireline. Arrow keys move it, Delete removes it.");
  const marker = new Overlay({ element: button, positioning: "center-center", stopEvent: true });
  map.addOverlay(marker);
  follow(map, button, {
    place: () => scene.state.viewpoint,
    cell: () => Number(scene.state.options.cell) || 1,
    move: (viewpoint) => scene.change({ viewpoint }),
    remove: () => scene.change({ viewpoint: null }),
  });
  scene.on(["viewpoint", "task"], () => {
    const { viewpoint, task } = scene.state;
    marker.setPosition(viewpoint && task === "turbines" ? [viewpoint.x, viewpoint.y] : undefined);
  });
}
