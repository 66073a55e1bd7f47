// What cells look like: each cell has a class by what the masts shown say of it together, each class a colour.

import { CUT, NEAREST, UNDECIDED, UNKNOWN, VERDICT, VISIBLE } from "./seen_cells.js";
import { HUES, SHARED, UNDECIDED_COLOUR, meanColour, rampColour } from "./palette.js";
import { classOf } from "./values.js";

/** @typedef {import("./seen_cells.js").SeenCells} SeenCells */
/** @typedef {import("./palette.js").Rgb} Rgb */
/** @typedef {import("./values.js").ValueMode} ValueMode */
/** @typedef {{cells: SeenCells, hue: number, selected: boolean}} Source  What one mast sees. */
/**
 * @typedef {object} Picture
 * @property {Float32Array} colours  Four for each class, red, green and blue times opacity, and opacity; all from 0 to 1.
 * @property {(row: number, column: number, classes: Uint16Array, nearest: Uint8Array) => void} classify
 *   Writes the classes of cells of a row from a column on, and which of them have the verdict of a cell near by.
 */

// The class of a cell by verdicts: a bit for each mast that sees it, and these.
const CLEAR = 1 << 8, OPEN = 1 << 9, CLASSES = 1 << 10;
const FAINT = 0.2, SINGLE = 0.55, SEVERAL = 0.68, CUT_SHARE = 0.45;

/** Calls `take(i, k)` for each cell `i` of the row from `column` on which has place `k` in the source's arrays.
 * @param {SeenCells} cells @param {number} row @param {number} column @param {number} count
 * @param {(i: number, k: number) => void} take */
function eachIn(cells, row, column, count, take) {
  const r = row - cells.row;
  if (r < 0 || r >= cells.rows) return;
  const from = Math.max(0, cells.column - column), to = Math.min(count, cells.column + cells.columns - column);
  const shift = r * cells.columns + column - cells.column;
  for (let i = from; i < to; ++i) take(i, i + shift);
}

/** Verdicts of one mast or several. @param {Source[]} sources @param {boolean} difference @returns {Picture} */
export function verdictPicture(sources, difference) {
  return {
    colours: difference ? differenceColours(sources) : togetherColours(sources),
    classify(row, column, classes, nearest) {
      sources.forEach(({ cells }, bit) => {
        const { codes } = cells;
        eachIn(cells, row, column, classes.length, (i, k) => {
          const verdict = codes[k] & VERDICT;
          if (verdict === VISIBLE) classes[i] |= (1 << bit) | CLEAR;
          else if (verdict === CUT) classes[i] |= 1 << bit;
          else if (verdict === UNDECIDED) classes[i] |= OPEN;
          if (codes[k] & NEAREST || verdict === UNKNOWN) nearest[i] = 1;
        });
      });
    },
  };
}

/** The best value of several masts, or the value of one. @param {Source[]} sources @param {ValueMode} mode @returns {Picture} */
export function valuePicture(sources, mode) {
  const colours = new Float32Array(4 * (mode.limits.length + 2));
  for (let i = 0; i <= mode.limits.length; ++i) put(colours, i + 1, rampColour(i, mode.limits.length + 1), 0.7);
  return {
    colours,
    classify(row, column, classes, nearest) {
      for (const { cells } of sources) {
        const { codes, values } = cells;
        eachIn(cells, row, column, classes.length, (i, k) => {
          if (codes[k] & NEAREST) nearest[i] = 1;
          if (!values || Number.isNaN(values[k])) return;
          const found = classOf(mode, values[k]) + 1;
          classes[i] = classes[i] === 0 ? found : Math.min(classes[i], found);
        });
      }
    },
  };
}

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
      if (at & OPEN) put(colours, at, UNDECIDED_COLOUR, 0.6);
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
