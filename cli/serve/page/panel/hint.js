// What to do first, over the map: until there is a mast, and then until a line of sight or a second mast shows that the
// planner has found out.

import { element } from "./elements.js";

/** @param {import("../state/scene.js").Scene} scene */
export function makeHint(scene) {
  const hint = element("hint");
  let known = scene.state.masts.length > 0;
  scene.on(["placing", "masts", "target"], () => {
    const { placing, masts, target } = scene.state;
    known ||= target !== null || masts.length > 1;
    const first = placing || masts.length === 0;
    hint.textContent = first ? "Click the map to place a mast" : "Drag the mast, or click the map for a line of sight";
    hint.hidden = !first && known;
  });
}
