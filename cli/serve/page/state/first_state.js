// What the page opens with, where its address says nothing else.

/** @typedef {import("../server/api.js").Info} Info */
/** @typedef {import("./scene.js").SceneState} SceneState */

import { FIRST_SITING } from "./plan.js";

const MOST_RADIUS = 10000;
const CELLS_ACROSS = 500;
const ROUND = [1, 2, 2.5, 5, 10];

/** The next round number from here up. @param {number} value */
export function roundUp(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return Number(((ROUND.find((step) => step * power >= value * 0.999) ?? 10) * power).toPrecision(3));
}

/** @param {Info} info @returns {SceneState} */
export function firstState(info) {
  const { xmin, ymin, xmax, ymax } = info.bounds;
  const radius = Math.min(MOST_RADIUS, roundUp(Math.min(xmax - xmin, ymax - ymin) / 4));
  const cell = roundUp(Math.max(info.data_spacing_m ?? 0, (2 * radius) / CELLS_ACROSS));
  return {
    task: "masts",
    masts: [],
    selected: null,
    show: "together",
    target: null,
    options: { radius: String(radius), cell: String(cell), "target-height": "2" },
    layers: { relief: "shade", contours: false, themes: info.tiles.themes },
    view: null,
    placing: false,
    turbines: [],
    turbine: null,
    part: "tips",
    viewpoint: null,
    search: null,
    served: { kind: "reach" },
    siting: FIRST_SITING,
    drawing: "search",
    plan: null,
    premises: null,
  };
}
