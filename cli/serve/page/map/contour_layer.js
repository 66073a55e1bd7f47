// Contour lines, every fifth of them bold.

import { contourInterval, contourPieces } from "./contours.js";
import { PathLayer } from "./path_layer.js";
import { tileGridOf } from "./relief_layer.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("./height_tiles.js").HeightTiles} HeightTiles */

const BOLD = 5;

export class ContourLayer extends PathLayer {
  /** @param {Scene} scene @param {HeightTiles} tiles @param {MediaQueryList} dark */
  constructor(scene, tiles, dark) {
    super(tileGridOf(tiles.info));
    this.tiles = tiles;
    this.dark = dark;
    dark.addEventListener("change", () => this.forget());
    scene.on(["layers"], () => this.setVisible(scene.state.layers.contours));
  }

  /** @param {number} resolution */
  variant(resolution) {
    return String(contourInterval(resolution, this.tiles.resolutions.at(-1) ?? 1));
  }

  /** @param {number[]} place @param {string} variant */
  async load([z, x, y], variant) {
    const tile = await this.tiles.get(z, x, y);
    const interval = Number(variant);
    const pixel = this.tiles.resolutions[z];
    const thin = new Path2D();
    const bold = new Path2D();
    const line = this.dark.matches ? "rgb(224 190 146 / 0.7)" : "rgb(140 92 44 / 0.75)";
    for (const { level, x0, y0, x1, y1 } of tile ? contourPieces(tile, this.tiles.size, interval) : []) {
      const path = Math.round(level / interval) % BOLD === 0 ? bold : thin;
      path.moveTo(x0 * pixel, y0 * pixel);
      path.lineTo(x1 * pixel, y1 * pixel);
    }
    return [
      { path: thin, line, width: 0.6 },
      { path: bold, line, width: 1.3 },
    ];
  }
}
