// What to do first, over the map: until there is a mast or a turbine, and then until a line of sight, a wireline or a
// second one shows that the planner has found out. For sites, how an area is drawn.

import { element } from "./elements.js";

/** @typedef {import("../state/scene.js").Scene} Scene */

/** What stands on the map, what a click there does once something does, and whether it has. @param {Scene} scene */
function ofTask({ state: { task, masts, turbines, target, viewpoint } }) {
  return task === "turbines"
    ? { what: "turbine", next: "for a wireline", count: turbines.length, done: viewpoint !== null }
    : { what: "mast", next: "for a line of sight", count: masts.length, done: target !== null };
}

/** @param {Scene} scene */
export function makeHint(scene) {
  const hint = element("hint");
  const touch = matchMedia("(pointer: coarse)");
  const known = new Set(scene.state.masts.length > 0 ? ["mast"] : []);
  const text = () => {
    const { placing, task } = scene.state;
    const click = touch.matches ? "Tap" : "Click";
    if (task === "sites") return placing ? `${click} the corners of the area, and the first one again` : "";
    const { what, next, count, done } = ofTask(scene);
    if (done || count > 1) known.add(what);
    if (placing || count === 0) return `${click} the map to place a ${what}`;
    return known.has(what) ? "" : `Drag the ${what}, or ${click.toLowerCase()} the map ${next}`;
  };
  scene.on(["placing", "masts", "target", "task", "turbines", "viewpoint"], () => {
    hint.textContent = text();
    hint.hidden = hint.textContent === "";
  });
}
