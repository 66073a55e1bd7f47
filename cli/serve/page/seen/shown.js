// What the map shows of the masts: which of them count, and in which colours.

import { valuePicture, verdictPicture } from "./picture.js";
import { valueModeOf } from "./values.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("./live_views.js").LiveViews} LiveViews */
/** @typedef {import("./picture.js").Source} Source */

/** The masts that count, each with its cells; those of the size of the mast selected alone, while sizes change.
 * @param {Scene} scene @param {LiveViews} views @returns {Source[]} */
export function sourcesOf(scene, views) {
  const { masts, show, selected } = scene.state;
  const sources = masts.flatMap((mast) => {
    const cells = views.of(mast.id)?.cells;
    return cells && (show !== "alone" || mast.id === selected)
      ? [{ cells, hue: mast.hue, selected: mast.id === selected }]
      : [];
  });
  const cell = (sources.find((source) => source.selected) ?? sources[0])?.cells.cell;
  return sources.filter((source) => source.cells.cell === cell);
}

/** @param {Scene} scene @param {LiveViews} views */
export function shownOf(scene, views) {
  const sources = sourcesOf(scene, views);
  const mode = valueModeOf(scene.state.options);
  if (sources.length === 0) return null;
  const picture = mode ? valuePicture(sources, mode) : verdictPicture(sources, scene.state.show === "difference");
  return { picture, cell: sources[0].cells.cell };
}
