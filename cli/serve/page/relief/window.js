// Which part of the ground the 3-D view shows, and how closely.

/** @typedef {import("../server/api.js").Info} Info */
/** @typedef {import("../state/scene.js").Place} Place */
/** @typedef {[west: number, south: number, east: number, north: number]} Extent */

/** So many points a browser turns about with ease. */
const MOST_POINTS = 150000;

/** The part of the store's extent that another one covers; all of it where they do not meet. @param {Info} info
 * @param {Extent} wanted @returns {Extent} */
function within({ bounds: { xmin, ymin, xmax, ymax } }, [west, south, east, north]) {
  /** @type {Extent} */
  const cut = [Math.max(west, xmin), Math.max(south, ymin), Math.min(east, xmax), Math.min(north, ymax)];
  return cut[0] < cut[2] && cut[1] < cut[3] ? cut : [xmin, ymin, xmax, ymax];
}

/** What lies within the radius of all places; all that the map shows where there are none. @param {Info} info
 * @param {Place[]} places @param {number} radius @param {Extent} shown @returns {Extent} */
export function extentFor(info, places, radius, shown) {
  if (places.length === 0 || !(radius > 0)) return within(info, shown);
  const xs = places.map(({ x }) => x);
  const ys = places.map(({ y }) => y);
  return within(info, [
    Math.min(...xs) - radius,
    Math.min(...ys) - radius,
    Math.max(...xs) + radius,
    Math.max(...ys) + radius,
  ]);
}

/** The least tolerance at which the extent has about as many points as a browser can show.
 * @param {Info} info @param {Extent} extent */
export function toleranceFor({ bounds: { xmin, ymin, xmax, ymax }, levels }, [west, south, east, north]) {
  const share = ((east - west) * (north - south)) / ((xmax - xmin) * (ymax - ymin));
  const fits = levels.find(({ query_vertices }) => query_vertices * share <= MOST_POINTS);
  return (fits ?? levels.at(-1))?.tolerance_m ?? 0;
}
