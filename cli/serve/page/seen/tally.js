// Counts cells that masts see together and apart, from what is kept of them.

import { CUT, OUTSIDE, UNKNOWN, VERDICT, VISIBLE } from "./seen_cells.js";

/** @typedef {import("./picture.js").Source} Source */
/** @typedef {{any: number, all: number, onlySelected: number, looked: number, area: number}} Tally
 *    Cells that any mast sees, all of them, only the one selected; cells that any looks at; the area of a cell, m². */

/** Whether a mast sees a cell, whatever cuts its Fresnel zone. @param {number} verdict */
const inSight = (verdict) => verdict === VISIBLE || verdict === CUT;

/** @param {Source[]} sources @param {(verdict: number) => boolean} [sees]  Which verdicts count. @returns {Tally} */
export function tally(sources, sees = inSight) {
  const column = Math.min(...sources.map(({ cells }) => cells.column));
  const row = Math.min(...sources.map(({ cells }) => cells.row));
  const right = Math.max(...sources.map(({ cells }) => cells.column + cells.columns));
  const bottom = Math.max(...sources.map(({ cells }) => cells.row + cells.rows));
  const columns = right - column;
  const masks = new Uint16Array(columns * (bottom - row));
  const LOOKED = 1 << 8;
  sources.forEach(({ cells }, bit) => {
    for (let k = 0; k < cells.codes.length; ++k) {
      const verdict = cells.codes[k] & VERDICT;
      if (verdict === OUTSIDE || verdict === UNKNOWN) continue;
      const r = Math.floor(k / cells.columns);
      const c = k - r * cells.columns;
      masks[(r + cells.row - row) * columns + c + cells.column - column] |= LOOKED | (sees(verdict) ? 1 << bit : 0);
    }
  });
  const every = (1 << sources.length) - 1;
  const own = sources.reduce((mask, { selected }, bit) => mask | (selected ? 1 << bit : 0), 0);
  const counts = { any: 0, all: 0, onlySelected: 0, looked: 0, area: sources[0].cells.cell ** 2 };
  for (const mask of masks) {
    if (mask === 0) continue;
    ++counts.looked;
    const seen = mask & every;
    if (seen !== 0) ++counts.any;
    if (seen === every) ++counts.all;
    if (seen !== 0 && seen === own) ++counts.onlySelected;
  }
  return counts;
}

/** How many places lie in a cell that any mast serves. @param {{x: number, y: number}[]} places @param {Source[]} sources
 * @param {(verdict: number) => boolean} serves */
export const countServed = (places, sources, serves) =>
  places.filter(({ x, y }) =>
    sources.some(({ cells }) => {
      const at = cells.at(x, y);
      return at >= 0 && serves(cells.codes[at] & VERDICT);
    }),
  ).length;
