// Paints cells into pixels. A pixel is one cell or a square of cells, and then has the share of them that are seen, so
// that thin strips do not vanish. What was painted is kept, and only what has changed is painted anew.

import { COLOUR, WAITING } from "./picture.js";

/** @typedef {import("./picture.js").Picture} Picture */
/** @typedef {import("./cell_window.js").CellWindow} CellWindow */
/** @typedef {{x: number, y: number, width: number, height: number}} Pixels */

const STRIPE = 3; // pixels of a row that are faint, of a period, where cells wait
const PERIOD = 6;
const STRIPED_SHARE = 0.45;

/** @param {number} x @param {number} y */
const phaseOf = (x, y) => (x + y) % PERIOD;

export class Mosaic {
  /** @param {CellWindow} at  whose columns and rows are multiples of `factor`
   * @param {number} factor  cells to a side of a pixel */
  constructor(at, factor) {
    this.at = at;
    this.factor = factor;
    this.image = new ImageData(at.columns / factor, at.rows / factor);
  }

  /** Paints the pixels that show a part of the cells, and tells which they are; none may.
   * @param {Picture} picture @param {CellWindow} part @returns {Pixels} */
  paint(picture, part) {
    const pixels = this.#pixelsOf(part);
    if (this.factor === 1) this.#paintCells(picture, pixels);
    else this.#paintShares(picture, pixels);
    return pixels;
  }

  /** @param {CellWindow} part @returns {Pixels} */
  #pixelsOf({ column, row, columns, rows }) {
    const { at, factor, image } = this;
    const x = Math.max(0, Math.floor((column - at.column) / factor));
    const y = Math.max(0, Math.floor((row - at.row) / factor));
    const right = Math.min(image.width, Math.ceil((column + columns - at.column) / factor));
    const bottom = Math.min(image.height, Math.ceil((row + rows - at.row) / factor));
    return { x, y, width: Math.max(0, right - x), height: Math.max(0, bottom - y) };
  }

  /** @param {Picture} picture @param {Pixels} pixels */
  #paintCells(picture, { x, y, width, height }) {
    const [plain, faint] = pixelsOfClasses(picture.colours);
    const out = new Uint32Array(this.image.data.buffer);
    const classes = new Uint16Array(width);
    for (let j = y; j < y + height; ++j) {
      classes.fill(0);
      picture.classify(this.at.row + j, this.at.column + x, classes);
      const row = out.subarray(j * this.image.width + x);
      for (let i = 0, phase = phaseOf(x, j); i < width; ++i, phase = phase < PERIOD - 1 ? phase + 1 : 0) {
        const found = classes[i];
        row[i] = (found & WAITING && phase < STRIPE ? faint : plain)[found & COLOUR];
      }
    }
  }

  /** @param {Picture} picture @param {Pixels} pixels */
  #paintShares(picture, { x, y, width, height }) {
    const { at, factor } = this;
    const classes = new Uint16Array(width * factor);
    const sums = new Float32Array(4 * width);
    const waiting = new Uint8Array(width);
    for (let j = y; j < y + height; ++j) {
      sums.fill(0);
      waiting.fill(0);
      for (let k = 0; k < factor; ++k) {
        classes.fill(0);
        picture.classify(at.row + j * factor + k, at.column + x * factor, classes);
        addLine(classes, picture.colours, factor, sums, waiting);
      }
      putPixels(this.image, { x, y: j }, sums, waiting, factor * factor);
    }
  }
}

/** The pixel of each class, as an image has its four bytes in memory: plain, and within stripes.
 * @param {Float32Array} colours */
function pixelsOfClasses(colours) {
  return [1, STRIPED_SHARE].map((share) => {
    const bytes = new Uint8ClampedArray(colours.length);
    for (let at = 0; at < colours.length; at += 4) putPixel(bytes, at, colours, at, share);
    return new Uint32Array(bytes.buffer);
  });
}

/** Writes a pixel of a sum of colours times opacities. @param {Uint8ClampedArray} data @param {number} to
 * @param {Float32Array} sums @param {number} from @param {number} share  of the opacity */
function putPixel(data, to, sums, from, share) {
  const opacity = sums[from + 3];
  const scale = opacity === 0 ? 0 : 255 / opacity;
  data[to] = scale * sums[from];
  data[to + 1] = scale * sums[from + 1];
  data[to + 2] = scale * sums[from + 2];
  data[to + 3] = 255 * opacity * share;
}

/** @param {Uint16Array} classes @param {Float32Array} colours @param {number} factor @param {Float32Array} sums
 * @param {Uint8Array} waiting */
function addLine(classes, colours, factor, sums, waiting) {
  for (let pixel = 0, i = 0; i < classes.length; ++pixel) {
    for (const end = i + factor; i < end; ++i) {
      if (classes[i] === 0) continue;
      const from = 4 * (classes[i] & COLOUR);
      const to = 4 * pixel;
      sums[to] += colours[from];
      sums[to + 1] += colours[from + 1];
      sums[to + 2] += colours[from + 2];
      sums[to + 3] += colours[from + 3];
      if (classes[i] & WAITING) waiting[pixel] = 1;
    }
  }
}

/** @param {ImageData} image @param {{x: number, y: number}} first @param {Float32Array} sums
 * @param {Uint8Array} waiting @param {number} cells */
function putPixels({ data, width }, { x, y }, sums, waiting, cells) {
  for (let i = 0, to = 4 * (y * width + x); i < waiting.length; ++i, to += 4) {
    putPixel(data, to, sums, 4 * i, (waiting[i] && phaseOf(x + i, y) < STRIPE ? STRIPED_SHARE : 1) / cells);
  }
}
