// Moves what a button on the map stands for: with the pointer, or with the arrow keys by a cell.

/** @typedef {import("../state/scene.js").Place} Place */
/**
 * @typedef {object} Movable
 * @property {() => Place | null | undefined} place
 * @property {() => number} cell
 * @property {(to: Place) => void} move
 * @property {() => void} remove   Called for the key Delete.
 */

const ARROWS = /** @type {Record<string, [number, number]>} */ ({
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
});
const FAST = 10; // cells with Shift

/**
 * Rounds to a tenth of a cell or less, to the next power of ten.
 * @param {Place} place
 * @param {number} cell
 * @returns {Place}
 */
export function roundedPlace({ x, y }, cell) {
  const digits = Math.max(0, 1 - Math.floor(Math.log10(cell)));
  const step = 10 ** Math.floor(Math.log10(cell / 10));
  const rounded = (/** @type {number} */ value) => Number((Math.round(value / step) * step).toFixed(digits));
  return { x: rounded(x), y: rounded(y) };
}

/** @param {import("../vendor/ol.js").OlMap} map @param {HTMLElement} button @param {Movable} movable */
export function follow(map, button, movable) {
  button.addEventListener("pointerdown", (event) => drag(map, button, movable, event));
  button.addEventListener("keydown", (event) => {
    if (event.key === "Delete") return movable.remove();
    const arrow = ARROWS[event.key];
    const place = movable.place();
    if (!arrow || !place) return;
    event.preventDefault();
    event.stopPropagation();
    const by = movable.cell() * (event.shiftKey ? FAST : 1);
    movable.move(roundedPlace({ x: place.x + arrow[0] * by, y: place.y + arrow[1] * by }, movable.cell()));
  });
}

/**
 * @param {import("../vendor/ol.js").OlMap} map
 * @param {HTMLElement} button
 * @param {Movable} movable
 * @param {PointerEvent} event
 */
function drag(map, button, movable, event) {
  const from = movable.place();
  if (event.button !== 0 || !from) return;
  const start = map.getEventCoordinate(event);
  const ended = new AbortController();
  const { signal } = ended;
  button.setPointerCapture(event.pointerId);
  let [lastX, lastY] = start;
  const move = (/** @type {Event} */ to) => {
    const [x, y] = map.getEventCoordinate(/** @type {PointerEvent} */ (to));
    if (x === lastX && y === lastY) return;
    [lastX, lastY] = [x, y];
    movable.move(roundedPlace({ x: from.x + x - start[0], y: from.y + y - start[1] }, movable.cell()));
  };
  // `pointermove` waits for the next picture, and would be answered in the one after that. Where the browser tells of
  // the pointer at once, the first news of each picture is taken.
  let early = false;
  button.addEventListener("pointerrawupdate", (to) => early || ((early = true), move(to)), { signal });
  button.addEventListener("pointermove", (to) => ((early = false), move(to)), { signal });
  for (const end of ["pointerup", "pointercancel"]) button.addEventListener(end, () => ended.abort(), { signal });
}
