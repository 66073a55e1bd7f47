// The far end of the line of sight on the map.

import { makePlaceMarker } from "./place_marker.js";

/** @param {import("../vendor/ol.js").OlMap} map @param {import("../state/scene.js").Scene} scene */
export const makeTargetMarker = (map, scene) =>
  makePlaceMarker(map, scene, {
    className: "target",
    label: "Far end of the line of sight",
    name: "target",
    keys: ["target", "masts", "selected", "task"],
    shown: () => (scene.farEnd?.name ? null : scene.farEnd),
  });
