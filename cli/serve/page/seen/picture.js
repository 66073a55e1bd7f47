// What cells look like: each cell has a class by what the masts shown say of it together, each class a colour.

import { CUT, NEAREST, UNDECIDED, VERDICT, VISIBLE } from "./seen_cells.js";
import { HUES, SHARED, UNDECIDED_COLOUR, UNDECIDED_OPACITY, meanColour, rampColour } from "./palette.js";
import { hullOf } from "./cell_window.js";
import { classOf } from "./values.js";

/** @typedef {import("./seen_cells.js").SeenCells} SeenCells */
/** @typedef {import("./palette.js").Rgb} Rgb */
/** @typedef {import("./values.js").ValueMode} ValueMode */
/** @typedef {import("./cell_window.js").CellWindow} CellWindow */
/** @typedef {{cells: SeenCells, hue: number, selected: boolean}} Source  What one mast sees. */
/**
 * @typedef {object} Picture
 * @property {Float32Array} colours  Four for each class, red, green and blue times opacity, and opacity; all from 0
 *   to 1.
 * @property {(row: number, column: number, classes: Uint16Array) => void} classify
 *   Adds to the classes of cells of a row from a column on.
 * @property {CellWindow} extent  About all cells that may have a class.
 */

/** The bit of a class that says that the verdict is that of a cell near by. */
export const WAITING = 1 << 15;
/** The bits of a class that choose its colour. */
export const COLOUR = WAITING - 1;

// The class of a cell by verdicts: a bit for each mast that sees it, and these.
const CLEAR = 1 << 8;
const OPEN = 1 << 9;
const CLASSES = 1 << 10;
const FAINT = 0.2;
const SINGLE = 0.55;
const SEVERAL = 0.68;
const CUT_SHARE = 0.45;

/** The cells of a row from `column` on that a source has: the first and the one after the last, counted from `column`,
 * and what is added for their places in the source's arrays. @param {SeenCells} cells @param {number} row
 * @param {number} column @param {number} count @returns {[from: number, to: number, shift: number]} */
function shareOfRow(cells, row, column, count) {
  const r = row - cells.row;
  if (r < 0 || r >= cells.rows) return [0, 0, 0];
  const from = Math.max(0, cells.column - column);
  const to = Math.min(count, cells.column + cells.columns - column);
  return [from, to, r * cells.columns + column - cells.column];
}

/** @param {Source[]} sources @returns {CellWindow} */
const extentOf = (sources) => sources.map(({ cells }) => /** @type {CellWindow} */ (cells)).reduce(hullOf);

/** What each code of a cell of the mast with this bit adds to its class. @param {number} bit @returns {Uint16Array} */
function classesOfCodes(bit) {
  const classes = new Uint16Array(VERDICT + NEAREST + 1);
  for (const near of [0, NEAREST]) {
    const waiting = near ? WAITING : 0;
    classes[VISIBLE | near] = (1 << bit) | CLEAR | waiting;
    classes[CUT | near] = (1 << bit) | waiting;
    classes[UNDECIDED | near] = OPEN | waiting;
  }
  return classes;
}

/** Verdicts of one mast or several. @param {Source[]} sources @param {boolean} difference @returns {Picture} */
export function verdictPicture(sources, difference) {
  const tables = sources.map((_, bit) => classesOfCodes(bit));
  return {
    extent: extentOf(sources),
    colours: difference ? differenceColours(sources) : togetherColours(sources),
    classify(row, column, classes) {
      for (let bit = 0; bit < sources.length; ++bit) {
        const { codes } = sources[bit].cells;
        const table = tables[bit];
        const [from, to, shift] = shareOfRow(sources[bit].cells, row, column, classes.length);
        for (let i = from; i < to; ++i) classes[i] |= table[codes[i + shift]];
      }
    },
  };
}

/**
 * The best value of several masts, or the value of one.
 * @param {Source[]} sources
 * @param {ValueMode} mode
 * @returns {Picture}
 */
export function valuePicture(sources, mode) {
  const colours = new Float32Array(4 * (mode.limits.length + 2));
  for (let i = 0; i <= mode.limits.length; ++i) put(colours, i + 1, rampColour(i, mode.limits.length + 1), 0.7);
  return {
    extent: extentOf(sources),
    colours,
    classify(row, column, classes) {
      for (const { cells } of sources) {
        const { codes, values } = cells;
        const [from, to, shift] = shareOfRow(cells, row, column, classes.length);
        for (let i = from; values && i < to; ++i) {
          const value = values[i + shift];
          if (!Number.isNaN(value)) {
            classes[i] = better(classes[i], (classOf(mode, value) + 1) | (codes[i + shift] & NEAREST ? WAITING : 0));
          }
        }
      }
    },
  };
}

/** The better of two classes, of which 0 is none. @param {number} one @param {number} other */
const better = (one, other) => (one === 0 || (other & COLOUR) < (one & COLOUR) ? other : one);

/** @param {Float32Array} colours @param {number} at @param {Rgb} rgb @param {number} opacity */
function put(colours, at, rgb, opacity) {
  colours.set([...rgb.map((channel) => (channel / 255) * opacity), opacity], 4 * at);
}

/** @param {Source[]} sources @param {number} mask */
const huesOf = (sources, mask) => sources.filter((_, bit) => mask & (1 << bit)).map(({ hue }) => HUES[hue]);

/** @param {(mask: number) => [Rgb, number]} ofMask @returns {Float32Array} */
function coloursBy(ofMask) {
  const colours = new Float32Array(4 * CLASSES);
  for (let at = 1; at < CLASSES; ++at) {
    const mask = at & 255;
    if (mask === 0) {
      if (at & OPEN) put(colours, at, UNDECIDED_COLOUR, UNDECIDED_OPACITY);
      continue;
    }
    const [colour, opacity] = ofMask(mask);
    put(colours, at, colour, at & CLEAR ? opacity : opacity * CUT_SHARE);
  }
  return colours;
}

/** @param {Source[]} sources */
function togetherColours(sources) {
  return coloursBy((mask) => {
    const hues = huesOf(sources, mask);
    return hues.length === 0 ? [SHARED, 0] : [meanColour(hues), hues.length > 1 ? SEVERAL : SINGLE];
  });
}

/** What the mast selected adds to the others: its own in its colour, what others see too in grey, the rest faint.
 * @param {Source[]} sources */
function differenceColours(sources) {
  const own = sources.reduce((mask, { selected }, bit) => mask | (selected ? 1 << bit : 0), 0);
  return coloursBy((mask) => {
    if ((mask & own) === mask) return [meanColour(huesOf(sources, mask)), SEVERAL];
    if (mask & own) return [SHARED, SINGLE];
    const hues = huesOf(sources, mask);
    return hues.length === 0 ? [SHARED, 0] : [meanColour(hues), FAINT];
  });
}
