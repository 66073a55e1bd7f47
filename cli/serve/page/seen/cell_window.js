// Rectangles of cells.

/** @typedef {{column: number, row: number, columns: number, rows: number}} CellWindow */

/** The smallest window about two. @param {CellWindow} one @param {CellWindow} other @returns {CellWindow} */
export function hullOf(one, other) {
  const column = Math.min(one.column, other.column);
  const row = Math.min(one.row, other.row);
  return {
    column,
    row,
    columns: Math.max(one.column + one.columns, other.column + other.columns) - column,
    rows: Math.max(one.row + one.rows, other.row + other.rows) - row,
  };
}
