// Contour lines of a tile of heights, by marching squares: in each square between four pixels straight lines between
// its sides.

/** @typedef {import("./height_tiles.js").HeightTile} HeightTile */
/** @typedef {{level: number, x0: number, y0: number, x1: number, y1: number}} Piece  In pixels of the tile. */

const PIXELS_APART = 0.6;
const ENLARGED = 4;
const ROUND = [1, 2, 5];

/** A round interval for a map of this resolution, so that lines stay apart on slopes; of pixels enlarged no more than
 * `ENLARGED` times, so that a tile has no more lines than are worth it.
 * @param {number} resolution
 * @param {number} finest */
export function contourInterval(resolution, finest) {
  const wanted = Math.max(0.5, PIXELS_APART * Math.max(resolution, finest / ENLARGED));
  const power = 10 ** Math.floor(Math.log10(wanted));
  return power * (ROUND.find((step) => step * power >= wanted) ?? 10);
}

/** @param {HeightTile} tile @param {number} size @param {number} interval @returns {Piece[]} */
export function contourPieces({ heights, width }, size, interval) {
  const border = (width - size) / 2;
  const pieces = /** @type {Piece[]} */ ([]);
  for (let y = -1; y < size; ++y) {
    for (let x = -1; x < size; ++x) {
      const at = (y + border) * width + x + border;
      const corners = [heights[at], heights[at + 1], heights[at + width + 1], heights[at + width]];
      const low = Math.min(...corners);
      const high = Math.max(...corners);
      if (!(high > low)) continue;
      for (let level = (Math.floor(low / interval) + 1) * interval; level <= high; level += interval) {
        pieces.push(...piecesOf(corners, level, x + 0.5, y + 0.5));
      }
    }
  }
  return pieces;
}

/** The pieces between the sides of a square that the level crosses. @param {number[]} corners clockwise from the
 * north-west @param {number} level @param {number} x @param {number} y @returns {Piece[]} */
function piecesOf(corners, level, x, y) {
  const crossings = [];
  for (let side = 0; side < 4; ++side) {
    const from = corners[side];
    const to = corners[(side + 1) % 4];
    if (from < level === to < level) continue;
    const t = (level - from) / (to - from);
    crossings.push(
      [
        [x + t, y],
        [x + 1, y + t],
        [x + 1 - t, y + 1],
        [x, y + 1 - t],
      ][side],
    );
  }
  const pieces = [];
  for (let i = 0; i + 1 < crossings.length; i += 2) {
    pieces.push({ level, x0: crossings[i][0], y0: crossings[i][1], x1: crossings[i + 1][0], y1: crossings[i + 1][1] });
  }
  return pieces;
}
