// What is known of the cells that one mast looks at, as bytes: the verdict, and whether it is only that of a cell near
// by.

/** @typedef {import("../server/tile_message.js").Tile} Tile */
/** @typedef {{seq: number, cell_m: number, column: number, row: number, columns: number, rows: number, kind: number,
 *    ground_m: number[]}} Begun  The server's word on the cells that tiles will be about. */

export const HIDDEN = 0;
export const VISIBLE = 1;
export const UNDECIDED = 2;
export const CUT = 3;
export const OUTSIDE = 4;
export const UNKNOWN = 5;
export const VERDICT = 7; // the bits of a code that have the verdict
export const NEAREST = 8; // the bit that says: no verdict of its own yet, the nearest cell's is shown

const SERVERS_OUTSIDE = 255;
const COUNTS = 1; // the kind of values that are counts
const COUNTED_OUTSIDE = 65535;

/** @param {number} verdict as the server sends it */
const codeOf = (verdict) => (verdict === SERVERS_OUTSIDE ? OUTSIDE : verdict);

export class SeenCells {
  /** @param {Begun} begun */
  constructor(begun) {
    this.seq = begun.seq;
    this.cell = begun.cell_m;
    this.column = begun.column;
    this.row = begun.row;
    this.columns = begun.columns;
    this.rows = begun.rows;
    this.grounds = begun.ground_m ?? [];
    this.counts = begun.kind === COUNTS;
    this.step = 9;
    this.verdicts = 0; // a bit for each verdict that has come
    this.codes = new Uint8Array(this.columns * this.rows).fill(UNKNOWN);
    this.values = begun.kind === 0 ? null : new Float32Array(this.columns * this.rows).fill(NaN);
  }

  /** Puts the tile's cells in their places, and around each the cells that it stands for until nearer ones are known.
   * @param {Tile} tile */
  take(tile) {
    this.step = tile.step;
    if (tile.step > 1) this.#takeSquares(tile);
    for (let j = 0, from = 0; j < tile.rows; ++j) {
      let to = (tile.row + j * tile.step - this.row) * this.columns + tile.column - this.column;
      for (let i = 0; i < tile.columns; ++i, ++from, to += tile.step) {
        const code = codeOf(tile.verdicts[from]);
        this.codes[to] = code;
        this.verdicts |= 1 << code;
        if (this.values && tile.values) this.values[to] = this.#valueOf(tile.values[from]);
      }
    }
  }

  /** A count of nothing is no value. @param {number} value as the server sends it */
  #valueOf(value) {
    return this.counts && (value === 0 || value === COUNTED_OUTSIDE) ? NaN : value;
  }

  /** @param {Tile} tile */
  #takeSquares({ step, column, row, columns, rows, verdicts, values }) {
    const half = (step - 1) / 2;
    const west = column - this.column - half;
    const north = row - this.row - half;
    for (let j = 0, at = 0; j < rows; ++j) {
      for (let i = 0; i < columns; ++i, ++at) {
        this.#fill(
          west + i * step,
          north + j * step,
          step,
          codeOf(verdicts[at]) | NEAREST,
          values ? this.#valueOf(values[at]) : NaN,
        );
      }
    }
  }

  /** Fills a square of cells, as far as it lies in the grid.
   * @param {number} column @param {number} row @param {number} size @param {number} code @param {number} value */
  #fill(column, row, size, code, value) {
    const from = Math.max(0, column);
    const to = Math.min(this.columns, column + size);
    for (let r = Math.max(0, row); r < Math.min(this.rows, row + size); ++r) {
      this.codes.fill(code, r * this.columns + from, r * this.columns + to);
      this.values?.fill(value, r * this.columns + from, r * this.columns + to);
    }
  }

  /** The place in `codes` and `values` of the cell at a point, or -1. @param {number} x @param {number} y */
  at(x, y) {
    const column = Math.floor(x / this.cell) - this.column;
    const row = Math.floor(-y / this.cell) - this.row;
    return column < 0 || row < 0 || column >= this.columns || row >= this.rows ? -1 : row * this.columns + column;
  }
}
