// Paints cells into pixels. A pixel is one cell or a square of cells, and then has the share of them that are seen, so
// that thin strips do not vanish.

import { COLOUR, WAITING } from "./picture.js";

/** @typedef {import("./picture.js").Picture} Picture */
/** @typedef {{column: number, row: number, columns: number, rows: number}} CellWindow */

const STRIPE = 3;
const STRIPED_SHARE = 0.45;

/**
 * @param {Picture} picture @param {CellWindow} at  whose columns and rows are multiples of `factor`
 * @param {number} factor  cells to a side of a pixel
 * @returns {ImageData}
 */
export function paintMosaic(picture, at, factor) {
  const width = at.columns / factor;
  const height = at.rows / factor;
  const image = new ImageData(width, height);
  const classes = new Uint16Array(at.columns);
  const sums = new Float32Array(4 * width);
  const waiting = new Uint8Array(width);
  for (let y = 0; y < height; ++y) {
    sums.fill(0);
    waiting.fill(0);
    for (let j = 0; j < factor; ++j) {
      classes.fill(0);
      picture.classify(at.row + y * factor + j, at.column, classes);
      addLine(classes, picture.colours, factor, sums, waiting);
    }
    putPixels(image, y, sums, waiting, factor * factor);
  }
  return image;
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

/**
 * @param {ImageData} image
 * @param {number} y
 * @param {Float32Array} sums
 * @param {Uint8Array} waiting
 * @param {number} cells
 */
function putPixels({ data, width }, y, sums, waiting, cells) {
  for (let x = 0, at = 4 * y * width; x < width; ++x, at += 4) {
    const opacity = sums[4 * x + 3];
    if (opacity === 0) continue;
    const striped = waiting[x] && (x + y) % (2 * STRIPE) < STRIPE;
    data[at] = (255 * sums[4 * x]) / opacity;
    data[at + 1] = (255 * sums[4 * x + 1]) / opacity;
    data[at + 2] = (255 * sums[4 * x + 2]) / opacity;
    data[at + 3] = ((255 * opacity) / cells) * (striped ? STRIPED_SHARE : 1);
  }
}
