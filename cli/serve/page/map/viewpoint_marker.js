// The place on the map from which a wireline is seen.

import { makePlaceMarker } from "./place_marker.js";

/** @param {import("../vendor/ol.js").OlMap} map @param {import("../state/scene.js").Scene} scene */
export const makeViewpointMarker = (map, scene) =>
  makePlaceMarker(map, scene, {
    className: "eye",
    label: "Viewpoint of the wireline",
    name: "viewpoint",
    keys: ["viewpoint", "task"],
    shown: () => (scene.state.task === "turbines" ? scene.state.viewpoint : null),
  });
