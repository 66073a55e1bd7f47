// The picture that lies on the ground of the 3-D view: plain ground, coloured where it is seen.

import { Mosaic } from "../seen/mosaic.js";

/** @typedef {import("./window.js").Extent} Extent */
/** @typedef {import("../map/verdict_layer.js").Shown} Shown */

const PIXELS = 1024;
const GROUND = "#d8d3c4";

/** Cells that cover the extent, so that each pixel of their picture has `factor` of them to a side.
 * @param {Extent} extent @param {number} cell @param {number} factor */
function cellsOver([west, south, east, north], cell, factor) {
  const side = cell * factor;
  const column = Math.floor(west / side);
  const row = Math.floor(-north / side);
  return {
    column: column * factor,
    row: row * factor,
    columns: (Math.ceil(east / side) - column) * factor,
    rows: (Math.ceil(-south / side) - row) * factor,
  };
}

/** Paints what is shown over an extent. @param {HTMLCanvasElement} canvas @param {Extent} extent @param {Shown} shown */
export function paintDrape(canvas, extent, shown) {
  const [west, south, east, north] = extent;
  const longer = Math.max(east - west, north - south);
  canvas.width = Math.max(1, Math.round((PIXELS * (east - west)) / longer));
  canvas.height = Math.max(1, Math.round((PIXELS * (north - south)) / longer));
  const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  context.fillStyle = GROUND;
  context.fillRect(0, 0, canvas.width, canvas.height);
  if (!shown) return;
  const { picture, cell } = shown;
  const factor = Math.max(1, Math.round(longer / PIXELS / cell));
  const at = cellsOver(extent, cell, factor);
  const tiles = document.createElement("canvas");
  const mosaic = new Mosaic(at, factor);
  mosaic.paint(picture, at);
  tiles.width = mosaic.image.width;
  tiles.height = mosaic.image.height;
  /** @type {CanvasRenderingContext2D} */ (tiles.getContext("2d")).putImageData(mosaic.image, 0, 0);
  const scale = canvas.width / (east - west);
  context.imageSmoothingEnabled = false;
  context.drawImage(
    tiles,
    (at.column * cell - west) * scale,
    (at.row * cell + north) * scale,
    at.columns * cell * scale,
    at.rows * cell * scale,
  );
}
