// Outlines of a theme's features, drawn as sharp as the screen allows from the server's tiles of rings.

import { Layer } from "../vendor/ol.js";
import { tileGridOf } from "./relief_layer.js";

/** @typedef {import("../server/api.js").Info} Info */
/** @typedef {import("ol/Map.js").FrameState} FrameState */

/** @type {Record<string, {fill: string, line: string}>} */
const COLOURS = {
  buildings: { fill: "rgb(120 72 60 / 0.55)", line: "rgb(92 50 40)" },
  vegetation: { fill: "rgb(70 120 60 / 0.4)", line: "rgb(50 92 44)" },
  water: { fill: "rgb(90 150 200 / 0.5)", line: "rgb(50 100 150)" },
};
const OTHER = { fill: "rgb(110 100 120 / 0.35)", line: "rgb(80 72 90)" };

export class ThemeLayer extends Layer {
  /** @type {Map<string, Path2D | null>} paths in metres from the tile's north-west corner; null while they are loaded */
  #tiles = new Map();
  #canvas = document.createElement("canvas");

  /** @param {Info} info @param {string} name */
  constructor(info, name) {
    super({});
    this.#canvas.className = "drawn";
    this.info = info;
    this.name = name;
    this.grid = tileGridOf(info);
    this.colours = COLOURS[info.themes.find((theme) => theme.name === name)?.kind ?? ""] ?? OTHER;
  }

  getSourceState() {
    return /** @type {const} */ ("ready");
  }

  /** @param {FrameState | null} frame @returns {HTMLElement} */
  render(frame) {
    if (!frame?.extent) return this.#canvas;
    const { size, pixelRatio, viewState } = frame, z = this.grid.getZForResolution(viewState.resolution);
    this.#canvas.width = Math.round(size[0] * pixelRatio);
    this.#canvas.height = Math.round(size[1] * pixelRatio);
    this.grid.forEachTileCoord(frame.extent, z, (tile) => this.#draw(tile, frame));
    return this.#canvas;
  }

  /** @param {number[]} tile @param {FrameState} frame */
  #draw(tile, { pixelRatio, viewState }) {
    const name = tile.join("/"), path = this.#tiles.get(name);
    if (path === undefined) this.#load(name, tile);
    if (!path) return;
    const [west, south, east, north] = this.grid.getTileCoordExtent(tile), scale = pixelRatio / viewState.resolution;
    const pen = /** @type {CanvasRenderingContext2D} */ (this.#canvas.getContext("2d"));
    pen.setTransform(scale, 0, 0, -scale, this.#canvas.width / 2 + (west - viewState.center[0]) * scale, this.#canvas.height / 2 - (north - viewState.center[1]) * scale);
    pen.save();
    pen.beginPath();
    pen.rect(0, 0, east - west, south - north);
    pen.clip();
    pen.fillStyle = this.colours.fill;
    pen.fill(path, "evenodd");
    pen.strokeStyle = this.colours.line;
    pen.lineWidth = 1 / scale;
    pen.stroke(path);
    pen.restore();
  }

  /** @param {string} name @param {number[]} tile */
  async #load(name, tile) {
    this.#tiles.set(name, null);
    const answer = await fetch(`/tiles/theme/${encodeURIComponent(this.name)}/${name}?v=${encodeURIComponent(this.info.version)}`);
    const { rings } = answer.status === 200 ? await answer.json() : { rings: [] };
    const [west, , , north] = this.grid.getTileCoordExtent(tile);
    this.#tiles.set(name, pathOf(rings, west, north));
    this.changed();
  }
}

/** @param {number[][]} rings @param {number} west @param {number} north */
function pathOf(rings, west, north) {
  const path = new Path2D();
  for (const ring of rings) {
    path.moveTo(ring[0] - west, ring[1] - north);
    for (let i = 2; i + 1 < ring.length; i += 2) path.lineTo(ring[i] - west, ring[i + 1] - north);
    path.closePath();
  }
  return path;
}

/** Keeps on the map the layers of the themes that are to be drawn, above those below them now.
 * @param {import("../vendor/ol.js").OlMap} map @param {Info} info @param {import("../state/scene.js").Scene} scene */
export function drawThemes(map, info, scene) {
  const layers = info.tiles.themes.map((name) => new ThemeLayer(info, name));
  layers.forEach((layer) => map.addLayer(layer));
  scene.on(["layers"], () => layers.forEach((layer) => layer.setVisible(scene.state.layers.themes.includes(layer.name))));
}
