// On a phone the column is a sheet that comes from below: a button opens and closes it, and tells what is seen meanwhile.
// What is planned stays in view.

import { keepingPlace } from "../map/keeping_place.js";
import { element } from "./elements.js";
import { summaryOf } from "./mast_row.js";
import { viewerOf } from "../seen/viewers.js";

/** @typedef {import("../state/scene.js").Scene} Scene */

/** What the map should not hide: the far end of a line, or what is selected. @param {Scene} scene */
function placeOf({ state, farEnd }) {
  if (state.task === "turbines") return state.turbines.find(({ id }) => id === state.turbine) ?? null;
  return farEnd ?? viewerOf(state);
}

/** @param {Scene} scene @param {import("../seen/live_views.js").LiveViews} views
 * @param {import("../vendor/ol.js").OlMap} map */
export function makeSheet(scene, views, map) {
  const button = element("sheet-button");
  const column = element("column");
  const said = element("sheet-said");
  views.onChange(() => {
    const viewer = viewerOf(scene.state);
    const view = viewer ? views.of(viewer.id) : undefined;
    // While a new answer comes, the one before stays.
    if (!viewer || view?.error) said.textContent = "";
    else if (view?.done) said.textContent = `${viewer.name} ${summaryOf(view.done)}`;
  });
  button.addEventListener("click", () => {
    keepingPlace(map, placeOf(scene), () => {
      const open = column.classList.toggle("open");
      button.setAttribute("aria-expanded", String(open));
    });
  });
}
