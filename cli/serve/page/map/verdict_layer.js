// The layer of what masts see: a mosaic of cells, painted anew when cells come or the map leaves it.

import { Layer } from "../vendor/ol.js";
import { paintMosaic } from "../seen/mosaic.js";

/** @typedef {import("../seen/picture.js").Picture} Picture */
/** @typedef {{picture: Picture, cell: number} | null} Shown */
/** @typedef {import("../seen/mosaic.js").CellWindow & {factor: number}} MosaicWindow */

const MARGIN = 0.25; // of the map's width around it, so that a short move of the map needs no new mosaic

/** Cells to a side of a pixel of the mosaic, which is not much smaller than the screen's. @param {number} resolution
 * @param {number} cell */
const factorFor = (resolution, cell) => Math.max(1, Math.round(resolution / cell));

/** @param {number[]} extent @param {number} resolution @param {number} cell @returns {MosaicWindow} */
function windowFor(extent, resolution, cell) {
  const factor = factorFor(resolution, cell);
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
    factor,
  };
}

/** @param {MosaicWindow} at @param {number[]} extent @param {number} cell */
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
  /** @type {MosaicWindow | null} */
  #window = null;
  #mosaic = document.createElement("canvas");
  #canvas = document.createElement("canvas");

  constructor() {
    super({});
    this.#canvas.className = "drawn";
  }

  /** @param {Shown} shown */
  show(shown) {
    this.#shown = shown;
    this.#window = null;
    this.changed();
  }

  getSourceState() {
    return /** @type {const} */ ("ready");
  }

  /** @param {import("ol/Map.js").FrameState | null} frame @returns {HTMLElement} */
  render(frame) {
    if (!frame) return this.#canvas;
    const { size, pixelRatio, viewState, extent } = frame;
    const canvas = this.#canvas;
    canvas.width = Math.round(size[0] * pixelRatio);
    canvas.height = Math.round(size[1] * pixelRatio);
    if (!this.#shown || !extent) return canvas;
    const at = this.#paint(extent, viewState.resolution, this.#shown);
    const { cell } = this.#shown;
    const scale = pixelRatio / viewState.resolution;
    const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    pen.imageSmoothingEnabled = at.factor > 1;
    pen.drawImage(
      this.#mosaic,
      canvas.width / 2 + (at.column * cell - viewState.center[0]) * scale,
      canvas.height / 2 + (at.row * cell + viewState.center[1]) * scale,
      at.columns * cell * scale,
      at.rows * cell * scale,
    );
    return canvas;
  }

  /** Paints the mosaic unless it holds this extent already.
   * @param {number[]} extent @param {number} resolution @param {NonNullable<Shown>} shown @returns {MosaicWindow} */
  #paint(extent, resolution, { picture, cell }) {
    const kept = this.#window;
    if (kept && kept.factor === factorFor(resolution, cell) && holds(kept, extent, cell)) return kept;
    const at = windowFor(extent, resolution, cell);
    const image = paintMosaic(picture, at, at.factor);
    this.#mosaic.width = image.width;
    this.#mosaic.height = image.height;
    /** @type {CanvasRenderingContext2D} */ (this.#mosaic.getContext("2d")).putImageData(image, 0, 0);
    this.#window = at;
    return at;
  }
}
