// What the map shows of the masts, sites or turbines: which of them count, and in which colours.

import { valuePicture, verdictPicture } from "./picture.js";
import { HUBS, TIPS, modeOf, showOf, viewerOf, viewersOf } from "./viewers.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("./live_views.js").LiveViews} LiveViews */
/** @typedef {import("./picture.js").Source} Source */

/** Who counts: all masts or sites, the one selected, or one of the views of turbines. @param {Scene} scene
 * @returns {{id: number, hue: number, selected: boolean}[]} */
function counted({ state }) {
  if (state.task === "turbines") return [{ id: state.part === "hubs" ? HUBS : TIPS, hue: 0, selected: true }];
  const chosen = viewerOf(state)?.id;
  return viewersOf(state)
    .map(({ id, hue }) => ({ id, hue, selected: id === chosen }))
    .filter(({ selected }) => selected || showOf(state) !== "alone");
}

/** Those that count, each with its cells; those of the size of the one selected alone, while sizes change.
 * @param {Scene} scene @param {LiveViews} views @returns {Source[]} */
export function sourcesOf(scene, views) {
  const sources = counted(scene).flatMap(({ id, ...others }) => {
    const cells = views.of(id)?.cells;
    return cells ? [{ cells, ...others }] : [];
  });
  const cell = (sources.find((source) => source.selected) ?? sources[0])?.cells.cell;
  return sources.filter((source) => source.cells.cell === cell);
}

/** @param {Scene} scene @param {LiveViews} views */
export function shownOf(scene, views) {
  const sources = sourcesOf(scene, views);
  const mode = modeOf(scene.state);
  if (sources.length === 0) return null;
  const picture = mode ? valuePicture(sources, mode) : verdictPicture(sources, showOf(scene.state) === "difference");
  return { picture, cell: sources[0].cells.cell };
}
