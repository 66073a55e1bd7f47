// On a phone the column is a sheet that comes from below: a button opens and closes it. What is planned stays in view.

import { keepingPlace } from "../map/keeping_place.js";
import { element } from "./elements.js";
import { viewerOf } from "../seen/viewers.js";

/** @typedef {import("../state/scene.js").Scene} Scene */

/** What the map should not hide: the far end of a line, or what is selected. @param {Scene} scene */
function placeOf({ state, farEnd }) {
  if (state.task === "turbines") return state.turbines.find(({ id }) => id === state.turbine) ?? null;
  return farEnd ?? viewerOf(state);
}

/** @param {Scene} scene @param {import("../vendor/ol.js").OlMap} map */
export function makeSheet(scene, map) {
  const button = element("sheet-button");
  const column = element("column");
  button.addEventListener("click", () => {
    keepingPlace(map, placeOf(scene), () => {
      const open = column.classList.toggle("open");
      button.setAttribute("aria-expanded", String(open));
    });
  });
}
