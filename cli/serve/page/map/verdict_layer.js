// The layer of what masts see: a mosaic of cells, painted anew when cells come or the map leaves it.

import { Layer } from "../vendor/ol.js";
import { Mosaic } from "../seen/mosaic.js";

/** @typedef {import("../seen/picture.js").Picture} Picture */
/** @typedef {{picture: Picture, cell: number} | null} Shown */
/** @typedef {import("../seen/cell_window.js").CellWindow} CellWindow */
/** @typedef {import("ol/Map.js").FrameState} FrameState */

const MARGIN = 0.25; // of the map's width around it, so that a short move of the map needs no new mosaic

/** Cells to a side of a pixel of the mosaic, which is not much smaller than the screen's. @param {number} resolution
 * @param {number} cell */
const factorFor = (resolution, cell) => Math.max(1, Math.round(resolution / cell));

/** The cells on the map and around it, as many as make whole pixels.
 * @param {number[]} extent @param {number} factor @param {number} cell @returns {CellWindow} */
function windowFor(extent, factor, cell) {
  const side = factor * cell;
  const dx = MARGIN * (extent[2] - extent[0]);
  const dy = MARGIN * (extent[3] - extent[1]);
  const column = Math.floor((extent[0] - dx) / side);
  const row = Math.floor((-extent[3] - dy) / side);
  const right = Math.ceil((extent[2] + dx) / side);
  const bottom = Math.ceil((-extent[1] + dy) / side);
  return {
    column: column * factor,
    row: row * factor,
    columns: (right - column) * factor,
    rows: (bottom - row) * factor,
  };
}

/** @param {CellWindow} at @param {number[]} extent @param {number} cell */
function holds(at, extent, cell) {
  return (
    at.column * cell <= extent[0] &&
    (at.column + at.columns) * cell >= extent[2] &&
    at.row * cell <= -extent[3] &&
    (at.row + at.rows) * cell >= -extent[1]
  );
}

export class VerdictLayer extends Layer {
  /** @type {Shown} */
  #shown = null;
  /** @type {Mosaic | null} */
  #mosaic = null;
  /** How the map lay when it was last drawn. @type {FrameState | null} */
  #frame = null;
  /** The windows of cells that are not painted yet as they are shown. @type {CellWindow[]} */
  #stale = [];
  #tiles = document.createElement("canvas");
  #canvas = document.createElement("canvas");

  constructor() {
    super({});
    this.#canvas.className = "drawn";
  }

  /** Shows it at once, without the other layers. @param {Shown} shown
   * @param {CellWindow[] | null} [come]  Where alone it is not what it was. */
  show(shown, come = null) {
    if (come?.length === 0) return;
    this.#stale.push(...(come ?? [this.#shown, shown].flatMap((some) => (some ? [some.picture.extent] : []))));
    if (shown?.cell !== this.#shown?.cell) this.#mosaic = null;
    this.#shown = shown;
    if (this.#frame) this.#draw(this.#frame);
  }

  getSourceState() {
    return /** @type {const} */ ("ready");
  }

  /** @param {FrameState | null} frame @returns {HTMLElement} */
  render(frame) {
    this.#frame = frame;
    if (frame) this.#draw(frame);
    return this.#canvas;
  }

  /** @param {FrameState} frame */
  #draw({ size, pixelRatio, viewState, extent }) {
    const canvas = this.#canvas;
    canvas.width = Math.round(size[0] * pixelRatio);
    canvas.height = Math.round(size[1] * pixelRatio);
    if (!this.#shown || !extent) return;
    const { at, factor } = this.#paint(extent, viewState.resolution, this.#shown);
    const { cell } = this.#shown;
    const scale = pixelRatio / viewState.resolution;
    const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    pen.imageSmoothingEnabled = factor > 1;
    pen.drawImage(
      this.#tiles,
      canvas.width / 2 + (at.column * cell - viewState.center[0]) * scale,
      canvas.height / 2 + (at.row * cell + viewState.center[1]) * scale,
      at.columns * cell * scale,
      at.rows * cell * scale,
    );
  }

  /** Paints what is not painted yet.
   * @param {number[]} extent @param {number} resolution @param {NonNullable<Shown>} shown @returns {Mosaic} */
  #paint(extent, resolution, { picture, cell }) {
    const factor = factorFor(resolution, cell);
    let mosaic = this.#mosaic;
    if (!mosaic || mosaic.factor !== factor || !holds(mosaic.at, extent, cell)) {
      this.#mosaic = mosaic = new Mosaic(windowFor(extent, factor, cell), factor);
      this.#tiles.width = mosaic.image.width;
      this.#tiles.height = mosaic.image.height;
      this.#stale = [picture.extent];
    }
    const pen = /** @type {CanvasRenderingContext2D} */ (this.#tiles.getContext("2d"));
    for (const part of this.#stale) {
      const { x, y, width, height } = mosaic.paint(picture, part);
      if (width > 0 && height > 0) pen.putImageData(mosaic.image, 0, 0, x, y, width, height);
    }
    this.#stale = [];
    return mosaic;
  }
}
