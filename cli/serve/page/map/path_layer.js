// A layer of lines and areas that come tile by tile and are drawn as sharp as the screen allows.

import { Layer } from "../vendor/ol.js";

/** @typedef {import("ol/Map.js").FrameState} FrameState */
/** @typedef {number[]} TileCoordinate  z, x and y. */
/** @typedef {{text: string, x: number, y: number, angle: number, colour: string, halo: string}} Writing
 *    A text about a place, turned clockwise. */
/** @typedef {{path: Path2D, fill?: string, line: string, width: number, labels?: Writing[]}} Drawing
 *    A path in metres to the east and the south of the tile's north-west corner, as are the places of labels; `width` of
 *    its line in pixels. */

const FONT_PIXELS = 11;
const HALO_PIXELS = 3;

/** Writes a text upright to its line, in pixels of the screen. @param {CanvasRenderingContext2D} pen
 * @param {Writing} label @param {number} scale  Of the pen. @param {number} pixelRatio */
function write(pen, { text, x, y, angle, colour, halo }, scale, pixelRatio) {
  pen.save();
  pen.translate(x, y);
  pen.rotate(angle);
  pen.scale(pixelRatio / scale, pixelRatio / scale);
  pen.font = `${FONT_PIXELS}px system-ui, sans-serif`;
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  pen.lineJoin = "round";
  pen.lineWidth = HALO_PIXELS;
  pen.strokeStyle = halo;
  pen.strokeText(text, 0, 0);
  pen.fillStyle = colour;
  pen.fillText(text, 0, 0);
  pen.restore();
}

export class PathLayer extends Layer {
  /** @type {Map<string, Drawing[]>} empty while they are loaded */
  #tiles = new Map();
  #canvas = document.createElement("canvas");

  /** @param {import("../vendor/ol.js").TileGrid} grid */
  constructor(grid) {
    super({});
    this.grid = grid;
    this.#canvas.className = "drawn";
  }

  /** What tiles depend on beside their place. @param {number} _resolution @returns {string} */
  variant(_resolution) {
    return "";
  }

  /** @param {TileCoordinate} _tile @param {string} _variant @returns {Promise<Drawing[]>} */
  async load(_tile, _variant) {
    return [];
  }

  /** Loads all tiles anew, when they are next seen. */
  forget() {
    this.#tiles.clear();
    this.changed();
  }

  getSourceState() {
    return /** @type {const} */ ("ready");
  }

  /** @param {FrameState | null} frame @returns {HTMLElement} */
  render(frame) {
    if (!frame?.extent) return this.#canvas;
    const { size, pixelRatio, viewState } = frame;
    const variant = this.variant(viewState.resolution);
    this.#canvas.width = Math.round(size[0] * pixelRatio);
    this.#canvas.height = Math.round(size[1] * pixelRatio);
    this.grid.forEachTileCoord(
      frame.extent,
      this.grid.getZForResolution(viewState.resolution),
      (/** @type {TileCoordinate} */ tile) => this.#draw([...tile], variant, frame),
    );
    return this.#canvas;
  }

  /** @param {TileCoordinate} tile @param {string} variant @param {FrameState} frame */
  #draw(tile, variant, { pixelRatio, viewState }) {
    const [west, south, east, north] = this.grid.getTileCoordExtent(tile);
    const scale = pixelRatio / viewState.resolution;
    const pen = /** @type {CanvasRenderingContext2D} */ (this.#canvas.getContext("2d"));
    pen.setTransform(
      scale,
      0,
      0,
      scale,
      this.#canvas.width / 2 + (west - viewState.center[0]) * scale,
      this.#canvas.height / 2 - (north - viewState.center[1]) * scale,
    );
    pen.save();
    pen.beginPath();
    pen.rect(0, 0, east - west, north - south);
    pen.clip();
    for (const { path, fill, line, width, labels = [] } of this.#drawings(tile, variant)) {
      if (fill) {
        pen.fillStyle = fill;
        pen.fill(path, "evenodd");
      }
      pen.strokeStyle = line;
      pen.lineWidth = (width * pixelRatio) / scale;
      pen.stroke(path);
      for (const label of labels) write(pen, label, scale, pixelRatio);
    }
    pen.restore();
  }

  /** @param {TileCoordinate} tile @param {string} variant @returns {Drawing[]} */
  #drawings(tile, variant) {
    const name = `${tile.join("/")} ${variant}`;
    const kept = this.#tiles.get(name);
    if (kept) return kept;
    this.#tiles.set(name, []);
    this.load(tile, variant).then(
      (drawings) => {
        this.#tiles.set(name, drawings);
        this.changed();
      },
      () => this.#tiles.delete(name),
    );
    return [];
  }
}
