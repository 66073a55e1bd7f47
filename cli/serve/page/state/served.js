// What sites are to serve: all ground in their reach, ground in view or in an area, places of a file, or buildings.

/** @typedef {import("./scene.js").Place} Place */
/** @typedef {{kind: "reach"} | {kind: "view"} | {kind: "premises"} | {kind: "area", ring: number[] | null}
 *   | {kind: "places", file: string, upload: string, places: Place[], rows: number}} Served
 *    `ring` is [x0, y0, x1, y1, ...], null until it is drawn; `upload` is the server's name for a file, empty until one
 *    is loaded. Of its rows the page has the first places. */
/** @typedef {Served["kind"]} ServedKind */

export const SERVED_KINDS = /** @type {ServedKind[]} */ (["reach", "view", "area", "places", "premises"]);

/** So many cells of an area are sent to the server. */
export const MOST_CELLS_SERVED = 100000;

/** What is served of a kind that has just been chosen. @param {ServedKind} kind @returns {Served} */
export function servedOf(kind) {
  if (kind === "area") return { kind, ring: null };
  return kind === "places" ? { kind, file: "", upload: "", places: [], rows: 0 } : { kind };
}

/** Places of a file that was sent. @param {string} file  The planner's name for it.
 * @param {import("../server/api.js").Upload} upload @returns {Served} */
export const placesServed = (file, { name, rows, unusable, places }) => ({
  ...{ kind: "places", file, upload: name, places },
  rows: rows - unusable,
});

/** Whether a ring goes round a place. @param {number[]} ring @param {number} x @param {number} y */
export function encloses(ring, x, y) {
  let inside = false;
  for (let i = 0; i < ring.length; i += 2) {
    const next = (i + 2) % ring.length;
    const [ax, ay, bx, by] = [ring[i], ring[i + 1], ring[next], ring[next + 1]];
    if (ay > y !== by > y && x < ax + ((y - ay) / (by - ay)) * (bx - ax)) inside = !inside;
  }
  return inside;
}

/** The middles of the map's cells that lie in a ring, from the north-west. Throws where they are too many.
 * @param {number[]} ring @param {number} cell @returns {Place[]} */
export function cellsIn(ring, cell) {
  const xs = ring.filter((_, i) => i % 2 === 0);
  const ys = ring.filter((_, i) => i % 2 === 1);
  const [west, east, south, north] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const inBox = ((east - west) * (north - south)) / cell ** 2;
  if (inBox > MOST_CELLS_SERVED) {
    const least = Math.ceil(10 * cell * Math.sqrt(inBox / MOST_CELLS_SERVED)) / 10;
    throw new Error(
      `The area has more than ${MOST_CELLS_SERVED} cells: take a cell of ${least} m or more, or a smaller area.`,
    );
  }
  const places = [];
  for (let row = Math.floor(north / cell); row >= Math.floor(south / cell); --row) {
    for (let column = Math.floor(west / cell); column <= Math.floor(east / cell); ++column) {
      const place = { x: (column + 0.5) * cell, y: (row + 0.5) * cell };
      if (encloses(ring, place.x, place.y)) places.push(place);
    }
  }
  return places;
}
