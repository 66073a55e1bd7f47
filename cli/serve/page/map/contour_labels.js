// Where the heights of contour lines are written: along the line, upright, where it is straightest, and few to a tile.

/** @typedef {import("./contours.js").Piece} Piece */
/** @typedef {{x: number, y: number}} Corner */
/** @typedef {{text: string, x: number, y: number, angle: number}} Label  In pixels of the tile; `angle` is clockwise. */

/** Every so many lines one is heavier. */
export const BOLD = 5;
const LETTER = 6.2; // the width of a figure, pixels of the screen
const LINE_HEIGHT = 12;
const APART = 130; // pixels of the screen between labels of a tile
const STRAIGHT = 0.94; // the least part that a chord is of its piece of line
const STEPS = 3; // places that are tried along the length of a label

/** Whether a contour is one of the heavier ones. @param {number} level @param {number} interval */
export const isBold = (level, interval) => Math.round(level / interval) % BOLD === 0;

/** The height as it is written. @param {number} level @param {number} interval */
const textOf = (level, interval) =>
  level
    .toFixed(Math.max(0, -Math.floor(Math.log10(interval))))
    .replace(/^-/, "−")
    .replace(/^−(0(\.0+)?)$/, "$1");

/** Joins pieces of one level to lines. @param {Piece[]} pieces @returns {Corner[][]} */
export function joined(pieces) {
  const key = (/** @type {number} */ x, /** @type {number} */ y) => `${Math.round(x * 1e3)},${Math.round(y * 1e3)}`;
  /** @type {Map<string, {at: Corner, beside: string[]}>} */
  const corners = new Map();
  const cornerAt = (/** @type {number} */ x, /** @type {number} */ y) => {
    const name = key(x, y);
    if (!corners.has(name)) corners.set(name, { at: { x, y }, beside: [] });
    return name;
  };
  for (const { x0, y0, x1, y1 } of pieces) {
    const [a, b] = [cornerAt(x0, y0), cornerAt(x1, y1)];
    if (a === b) continue;
    corners.get(a)?.beside.push(b);
    corners.get(b)?.beside.push(a);
  }
  const lines = /** @type {Corner[][]} */ ([]);
  const walk = (/** @type {string} */ from) => {
    const line = /** @type {Corner[]} */ ([]);
    for (let name = /** @type {string | undefined} */ (from); name !== undefined; ) {
      const corner = /** @type {{at: Corner, beside: string[]}} */ (corners.get(name));
      line.push(corner.at);
      const next = corner.beside.pop();
      if (next !== undefined) {
        const other = corners.get(next)?.beside ?? [];
        other.splice(other.indexOf(name), 1);
      }
      name = next;
    }
    if (line.length > 1) lines.push(line);
  };
  // Lines that end are walked from an end, then rings from anywhere.
  for (const [name, { beside }] of corners) if (beside.length === 1) walk(name);
  for (const [name, { beside }] of corners) while (beside.length > 0) walk(name);
  return lines;
}

/** The place at each multiple of a distance along a line. @param {Corner[]} line @param {number} step */
function placesAlong(line, step) {
  const places = [line[0]];
  let left = step;
  for (let i = 1; i < line.length; ++i) {
    let from = line[i - 1];
    let length = Math.hypot(line[i].x - from.x, line[i].y - from.y);
    while (length >= left) {
      const share = left / length;
      from = { x: from.x + share * (line[i].x - from.x), y: from.y + share * (line[i].y - from.y) };
      places.push(from);
      length -= left;
      left = step;
    }
    left -= length;
  }
  return places;
}

/** The angle of a chord for letters that stand upright. @param {Corner} from @param {Corner} to */
function uprightAngle(from, to) {
  const angle = Math.atan2(to.y - from.y, to.x - from.x);
  if (angle > Math.PI / 2) return angle - Math.PI;
  return angle <= -Math.PI / 2 ? angle + Math.PI : angle;
}

/** The places for a text along a line, each with how straight the line is there. @param {Corner[]} line
 * @param {string} text @param {number} width @param {number} margin @param {number} size
 * @returns {(Label & {straight: number})[]} */
function candidatesAlong(line, text, width, margin, size) {
  const step = width / STEPS;
  const places = placesAlong(line, step);
  const found = [];
  for (let i = 0; i + STEPS < places.length; ++i) {
    const [from, to] = [places[i], places[i + STEPS]];
    const x = (from.x + to.x) / 2;
    const y = (from.y + to.y) / 2;
    // A text is not cut by the edge of its tile.
    if (Math.min(x, y, size - x, size - y) < width / 2 + margin) continue;
    const straight = Math.hypot(to.x - from.x, to.y - from.y) / (STEPS * step);
    if (straight >= STRAIGHT) found.push({ text, x, y, angle: uprightAngle(from, to), straight });
  }
  return found;
}

/** Labels of a tile's contours: of the heavier lines, or of the others where none of these has room for one.
 * @param {Piece[]} pieces @param {number} size  Of the tile, pixels. @param {number} interval
 * @param {number} scale  Pixels of the screen to a pixel of the tile. @returns {Label[]} */
export function contourLabels(pieces, size, interval, scale) {
  /** @type {Map<number, Piece[]>} */
  const levels = new Map();
  for (const piece of pieces) {
    const level = Math.round(piece.level / interval);
    const same = levels.get(level);
    if (same) same.push(piece);
    else levels.set(level, [piece]);
  }
  const labels = /** @type {Label[]} */ ([]);
  for (const bold of [true, false]) {
    if (labels.length > 0) break;
    const candidates = [...levels]
      .filter(([level]) => (level % BOLD === 0) === bold)
      .flatMap(([level, some]) => {
        const text = textOf(level * interval, interval);
        const width = ((text.length + 1) * LETTER) / scale;
        return joined(some).flatMap((line) => candidatesAlong(line, text, width, LINE_HEIGHT / 2 / scale, size));
      });
    candidates.sort((a, b) => b.straight - a.straight || a.x - b.x || a.y - b.y);
    for (const { text, x, y, angle } of candidates) {
      if (labels.every((label) => Math.hypot(label.x - x, label.y - y) >= APART / scale)) {
        labels.push({ text, x, y, angle });
      }
    }
  }
  return labels;
}
