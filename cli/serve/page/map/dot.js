// A dot on the map, of the same size at every zoom.

import { Circle, Feature, Style } from "../vendor/ol.js";

/** @typedef {import("../vendor/ol.js").Fill} Fill */
/** @typedef {import("../vendor/ol.js").Stroke} Stroke */

/** @param {{x: number, y: number}} place @param {number} pixels  Its radius. @param {Fill | undefined} fill
 * @param {Stroke} stroke */
export function dotAt({ x, y }, pixels, fill, stroke) {
  const dot = new Feature(new Circle([x, y], 1));
  dot.setStyle((_, resolution) => new Style({ geometry: new Circle([x, y], pixels * resolution), fill, stroke }));
  return dot;
}
