// What is known of the cells that one mast looks at, as bytes: the verdict, and whether it is only that of a cell near
// by.

/** @typedef {import("../server/tile_message.js").Tile} Tile */
/** @typedef {import("./cell_window.js").CellWindow} CellWindow */
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

/** The cells that a tile's cells stand for. @param {Tile} tile @returns {CellWindow} */
function windowOf({ step, column, row, columns, rows }) {
  const half = (step - 1) / 2;
  return { column: column - half, row: row - half, columns: columns * step, rows: rows * step };
}

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
   * Returns the window of all these. @param {Tile} tile @returns {CellWindow} */
  take(tile) {
    this.step = tile.step;
    const codes = this.#codesOf(tile.verdicts);
    if (tile.step > 1) {
      this.#spread(
        tile,
        codes.map((code) => code | NEAREST),
        this.codes,
      );
    }
    this.#put(tile, codes, this.codes);
    if (this.values && tile.values) this.#spread(tile, this.#valuesOf(tile.values), this.values);
    return windowOf(tile);
  }

  /** @param {Uint8Array} verdicts as the server sends them */
  #codesOf(verdicts) {
    const codes = new Uint8Array(verdicts.length);
    let come = 0;
    for (let i = 0; i < verdicts.length; ++i) {
      codes[i] = verdicts[i] === SERVERS_OUTSIDE ? OUTSIDE : verdicts[i];
      come |= 1 << codes[i];
    }
    this.verdicts |= come;
    return codes;
  }

  /** A count of nothing is no value. @param {Uint16Array | Float32Array} values as the server sends them */
  #valuesOf(values) {
    const isNone = (/** @type {number} */ value) => this.counts && (value === 0 || value === COUNTED_OUTSIDE);
    return Float32Array.from(values, (value) => (isNone(value) ? NaN : value));
  }

  /** Puts what is known of a tile's cells in their places.
   * @param {Tile} tile @param {Uint8Array} found @param {Uint8Array} all */
  #put({ step, column, row, columns, rows }, found, all) {
    for (let j = 0, from = 0; j < rows; ++j) {
      let to = (row + j * step - this.row) * this.columns + column - this.column;
      for (const end = from + columns; from < end; ++from, to += step) all[to] = found[from];
    }
  }

  /** Puts it in all cells of the squares that a tile's cells are in the middle of, as far as these lie in the grid.
   * @template {Uint8Array | Float32Array} Numbers @param {Tile} tile @param {Numbers} found @param {Numbers} all */
  #spread(tile, found, all) {
    const { column, row } = windowOf(tile);
    const west = Math.max(0, column - this.column);
    const east = Math.min(this.columns, column - this.column + tile.columns * tile.step);
    const line = all.slice(0, Math.max(0, east - west));
    for (let j = 0; j < tile.rows; ++j) {
      const first = j * tile.columns;
      for (let i = 0; i < line.length; ++i) {
        line[i] = found[first + Math.floor((i + west + this.column - column) / tile.step)];
      }
      const north = row - this.row + j * tile.step;
      const south = Math.min(this.rows, north + tile.step);
      for (let r = Math.max(0, north); r < south; ++r) all.set(line, r * this.columns + west);
    }
  }

  /** The place in `codes` and `values` of the cell at a point, or -1. @param {number} x @param {number} y */
  at(x, y) {
    const column = Math.floor(x / this.cell) - this.column;
    const row = Math.floor(-y / this.cell) - this.row;
    return column < 0 || row < 0 || column >= this.columns || row >= this.rows ? -1 : row * this.columns + column;
  }
}
