// Masts that a click has put inside a building, where they see nothing, and the choice that puts them on top.

import { element } from "./elements.js";
import { viewersOf } from "../seen/viewers.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../seen/live_views.js").LiveViews} LiveViews */

/** What the program warns of such masts. */
const SEES_NOTHING = /within a feature and lower than its top/;

/** @param {Scene} scene @param {LiveViews} views */
export function makeInside(scene, views) {
  element("inside-up").addEventListener("click", () => scene.setOption("observer-on", "surface"));
  const isInside = (/** @type {number} */ id) =>
    (views.of(id)?.done?.warnings ?? []).some((/** @type {string} */ warning) => SEES_NOTHING.test(warning));
  views.onChange(() => {
    if (!views.settled) return; // while a mast moves, what was said holds
    const inside = viewersOf(scene.state).filter(({ id }) => isInside(id));
    const one = inside.length === 1;
    element("inside").hidden = inside.length === 0;
    element("inside-said").textContent =
      `${inside.map(({ name }) => name).join(", ")} ${one ? "stands" : "stand"} inside a building and ` +
      `${one ? "sees" : "see"} nothing from there.`;
  });
}
