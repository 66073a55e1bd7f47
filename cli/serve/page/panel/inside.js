// Masts that a click has put inside a building, and the choice that puts them on top.

import { element } from "./elements.js";
import { metresText } from "./words.js";
import { viewersOf } from "../seen/viewers.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../seen/live_views.js").LiveViews} LiveViews */

/** Where a mast stands, and what that means. @param {{name: string, height: number}} mast
 * @param {{theme: string, top_m: number}} within */
function insideText({ name, height }, { theme, top_m }) {
  const where = `${name} stands on the ground within ${theme}`;
  return height < top_m
    ? `${where}, ${metresText(top_m - height)} below the top, and sees nothing.`
    : `${where}, and rises ${metresText(height - top_m)} above the top.`;
}

/** @param {Scene} scene @param {LiveViews} views */
export function makeInside(scene, views) {
  element("inside-up").addEventListener("click", () => scene.setOption("observer-on", "surface"));
  views.onChange(() => {
    if (!views.settled) return; // while a mast moves, what was said holds
    const said = viewersOf(scene.state).flatMap((mast) => {
      const within = views.of(mast.id)?.done?.within;
      return within ? [insideText(mast, within)] : [];
    });
    element("inside").hidden = said.length === 0;
    element("inside-said").textContent = said.join(" ");
  });
}
