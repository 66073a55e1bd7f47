// Contour lines with their heights, every fifth of them bold.

import { contourLabels, isBold } from "./contour_labels.js";
import { contourInterval, contourPieces } from "./contours.js";
import { PathLayer } from "./path_layer.js";
import { tileGridOf } from "./relief_layer.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("./height_tiles.js").HeightTiles} HeightTiles */

export class ContourLayer extends PathLayer {
  /** @param {Scene} scene @param {HeightTiles} tiles @param {MediaQueryList} dark */
  constructor(scene, tiles, dark) {
    super(tileGridOf(tiles.info));
    this.tiles = tiles;
    this.dark = dark;
    dark.addEventListener("change", () => this.forget());
    scene.on(["layers"], () => this.setVisible(scene.state.layers.contours));
  }

  /** The interval, and how many times pixels of the finest tiles are enlarged, as a power of two.
   * @param {number} resolution */
  variant(resolution) {
    const finest = this.tiles.resolutions.at(-1) ?? 1;
    const enlarged = 2 ** Math.max(0, Math.floor(Math.log2(finest / resolution)));
    return `${contourInterval(resolution, finest)} ${enlarged}`;
  }

  /** @param {number[]} place @param {string} variant */
  async load([z, x, y], variant) {
    const tile = await this.tiles.get(z, x, y);
    const [interval, enlarged] = variant.split(" ").map(Number);
    const pixel = this.tiles.resolutions[z];
    const thin = new Path2D();
    const bold = new Path2D();
    const dark = this.dark.matches;
    const line = dark ? "rgb(224 190 146 / 0.7)" : "rgb(140 92 44 / 0.75)";
    const pieces = tile ? contourPieces(tile, this.tiles.size, interval) : [];
    for (const { level, x0, y0, x1, y1 } of pieces) {
      const path = isBold(level, interval) ? bold : thin;
      path.moveTo(x0 * pixel, y0 * pixel);
      path.lineTo(x1 * pixel, y1 * pixel);
    }
    const labels = contourLabels(pieces, this.tiles.size, interval, enlarged).map((label) => ({
      ...label,
      ...{ x: label.x * pixel, y: label.y * pixel },
      ...(dark
        ? { colour: "#f0d3ad", halo: "rgb(23 26 31 / 0.85)" }
        : { colour: "#6b4119", halo: "rgb(255 255 255 / 0.85)" }),
    }));
    return [
      { path: thin, line, width: 0.6 },
      { path: bold, line, width: 1.5, labels },
    ];
  }
}
