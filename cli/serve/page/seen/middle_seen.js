// Where most of what is seen lies, so that an eye knows where to look.

import { VERDICT, VISIBLE } from "./seen_cells.js";

/** The middle of all cells that are seen; null where none is.
 * @param {import("./seen_cells.js").SeenCells | null | undefined} cells */
export function middleSeen(cells) {
  if (!cells) return null;
  let columns = 0;
  let rows = 0;
  let count = 0;
  for (let k = 0; k < cells.codes.length; ++k) {
    if ((cells.codes[k] & VERDICT) !== VISIBLE) continue;
    const row = Math.floor(k / cells.columns);
    columns += k - row * cells.columns;
    rows += row;
    ++count;
  }
  if (count === 0) return null;
  const { cell, column, row } = cells;
  return { x: (column + columns / count + 0.5) * cell, y: -(row + rows / count + 0.5) * cell };
}
