// A choice of sites that the server has made, and what the planner does with it.

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./scene.js").Place} Place */
/** @typedef {import("./scene.js").Mast} Mast */
/** @typedef {Mast & {gain: number, chosen: Place}} Site  `gain` is what it added to those before, cells or weights. */
/**
 * @typedef {object} Plan
 * @property {Site[]} sites        In the order of the choice; where each stands now.
 * @property {number} selected     The id of a site.
 * @property {Place[]} candidates  Where else they may stand.
 * @property {{value: number, demand: number, gap: number, cell: number, wanted: number, asked: Asked,
 *   points: Place[] | null}} result  Counts of cells, or of what else was to be served; `wanted` is the number of sites
 *   that were asked for; `points` are the places that were to be served, where places were.
 * @property {import("../server/api.js").Job} job  The call that made it, with its files.
 */
/** @typedef {{what: string, unit: "ground" | "place" | "building"}} Asked  What was asked to be served, in words. */
/** @typedef {{count: string, height: string, spacing: string}} Siting  How many sites, how high their masts, and how far
 *    apart candidates are proposed, as it was typed. */
/** @typedef {import("../server/api.js").UploadedPlace} UploadedPlace */
/** @typedef {{ring: number[]} | {file: string, upload: string, places: UploadedPlace[], rings: number[][]}} Search
 *    An area that was drawn, [x0, y0, x1, y1, ...], or a file that was sent. */

/** @type {Siting} */
export const FIRST_SITING = { count: "3", height: "20", spacing: "" };

/** So many sites the page shows; the command line takes more. */
export const MOST_SITES = 8;
/** Sites have views of their own at the server. */
const FIRST_SITE = 32;

/** @param {{id: string, x: number, y: number, height_m: number, gain: number}[]} chosen @returns {Site[]} */
export function sitesOf(chosen) {
  return chosen.map(({ id, x, y, height_m, gain }, i) => ({
    ...{ id: FIRST_SITE + i, hue: i, name: /^\d+$/.test(id) ? `Site ${i + 1}` : id, x, y, height: height_m, gain },
    chosen: { x, y },
  }));
}

/** Whether a file of candidates says how high masts are. @param {Search | null} search */
export const haveHeights = (search) =>
  search !== null && "places" in search && search.places.some(({ height_m }) => height_m !== undefined);

/** @param {{chosen: Place, x: number, y: number}} site */
export const isMoved = ({ chosen, x, y }) => chosen.x !== x || chosen.y !== y;

/** @param {Scene} scene @param {number} id @param {Place} to */
export function moveSite(scene, id, to) {
  const { plan } = scene.state;
  if (!plan) return;
  const sites = plan.sites.map((site) => (site.id === id ? { ...site, ...to } : site));
  scene.change({ plan: { ...plan, sites, selected: id } });
}

/** @param {Scene} scene @param {number} selected */
export function selectSite(scene, selected) {
  const { plan } = scene.state;
  if (plan) scene.change({ plan: { ...plan, selected } });
}

/** Puts all sites back where they were chosen. @param {Scene} scene */
export function putBack(scene) {
  const { plan } = scene.state;
  if (plan) scene.change({ plan: { ...plan, sites: plan.sites.map((site) => ({ ...site, ...site.chosen })) } });
}

/** The area that a ring encloses, m². @param {number[]} ring */
export function areaOf(ring) {
  let twice = 0;
  for (let i = 0; i < ring.length; i += 2) {
    const next = (i + 2) % ring.length;
    twice += ring[i] * ring[next + 1] - ring[next] * ring[i + 1];
  }
  return Math.abs(twice) / 2;
}

/** The corners of a ring, the first one once more at the end. @param {number[]} ring */
export function closedCorners(ring) {
  const corners = [];
  for (let i = 0; i < ring.length; i += 2) corners.push([ring[i], ring[i + 1]]);
  return [...corners, corners[0]];
}

/** The area as the command line takes it. @param {number[]} ring */
export const polygonText = (ring) =>
  `POLYGON ((${closedCorners(ring)
    .map((corner) => corner.join(" "))
    .join(", ")}))`;
