// The layer of the ground: tiles of heights, drawn here as hillshade, slope or plain paper.

import { ImageTileSource, TileGrid, TileLayer } from "../vendor/ol.js";
import { relief } from "./shade.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../server/api.js").Info} Info */
/** @typedef {import("./height_tiles.js").HeightTiles} HeightTiles */

/** @param {Info} info */
export const tileGridOf = ({ tiles }) =>
  new TileGrid({ origin: tiles.origin, resolutions: tiles.resolutions, tileSize: tiles.size });

/**
 * @param {Info} info @param {Scene} scene @param {HeightTiles} tiles @param {MediaQueryList} dark
 * @param {import("../vendor/ol.js").Projection} projection
 */
export function makeReliefLayer(info, scene, tiles, dark, projection) {
  const loader = async (/** @type {number} */ z, /** @type {number} */ x, /** @type {number} */ y) => {
    const canvas = document.createElement("canvas");
    const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    canvas.width = canvas.height = tiles.size;
    const tile = await tiles.get(z, x, y);
    const { layers } = scene.state;
    if (!tile) return canvas;
    pen.putImageData(
      relief(tile, tiles.size, tiles.resolutions[z], { relief: layers.relief, dark: dark.matches }),
      0,
      0,
    );
    return canvas;
  };
  const source = new ImageTileSource({ loader, tileGrid: tileGridOf(info), projection, wrapX: false, transition: 0 });
  // OpenLayers takes a source that never changed for one that it has not drawn, and would miss the first change.
  source.refresh();
  const layer = new TileLayer({ source });
  dark.addEventListener("change", () => source.refresh());
  let drawn = scene.state.layers.relief;
  scene.on(["layers"], () => {
    if (drawn !== scene.state.layers.relief) source.refresh();
    drawn = scene.state.layers.relief;
  });
  return layer;
}
