// Tiles of cells as the server sends them; PROTOCOL.md has the layout.

/**
 * @typedef {object} Tile  A rectangle of every `step`-th cell in both directions.
 * @property {number} seq @property {number} id @property {number} step
 * @property {number} column @property {number} row @property {number} columns @property {number} rows
 * @property {Uint8Array} verdicts
 * @property {Uint16Array | Float32Array | null} values
 */

const HEADER = 32;
const UINT16 = 1;
const FLOAT32 = 2;
const padded = (/** @type {number} */ bytes) => (bytes + 3) & ~3;

/** @param {ArrayBuffer} message @returns {Tile[]} */
export function readTiles(message) {
  const tiles = [];
  const view = new DataView(message);
  for (let at = 0; at + HEADER <= message.byteLength; at += view.getUint32(at, true)) {
    tiles.push(readTile(message, view, at));
    if (view.getUint32(at, true) < HEADER) break;
  }
  return tiles;
}

/** @param {ArrayBuffer} message @param {DataView} view @param {number} at @returns {Tile} */
function readTile(message, view, at) {
  const columns = view.getUint32(at + 20, true);
  const rows = view.getUint32(at + 24, true);
  const cells = columns * rows;
  return {
    seq: view.getUint32(at + 4, true),
    id: view.getUint16(at + 8, true),
    step: view.getUint8(at + 10),
    column: view.getInt32(at + 12, true),
    row: view.getInt32(at + 16, true),
    columns,
    rows,
    verdicts: new Uint8Array(message, at + HEADER, cells),
    values: readValues(message, view.getUint8(at + 11), at + HEADER + padded(cells), cells),
  };
}

/** @param {ArrayBuffer} message @param {number} kind @param {number} at @param {number} cells */
function readValues(message, kind, at, cells) {
  if (kind === UINT16) return new Uint16Array(message, at, cells);
  if (kind === FLOAT32) return new Float32Array(message, at, cells);
  return null;
}
