// The scene as text in the page's address, so that a reload, a bookmark or a link shows the same again.
//
//   #mast=310375,183525,20,Mast%20A&selected=0&radius=10000&cell=50&show=together&at=310375,183525,25
//
// What is not about the page itself is an option of the command line under its own name.

import { FIRST_SITING, isMoved } from "./plan.js";
import { SERVED_KINDS, servedOf } from "./served.js";
import { MOST_TURBINES } from "./turbines.js";

/** @typedef {import("./scene.js").SceneState} SceneState */
/** @typedef {import("./scene.js").Mast} Mast */
/** @typedef {import("./scene.js").Target} Target */

/** @typedef {import("./turbines.js").Turbine} Turbine */

/** What is asked of sites, by the options' names. */
const SITING = /** @type {const} */ ([
  ["count", "count"],
  ["mast-height", "height"],
  ["spacing", "spacing"],
]);
const OF_THE_PAGE = [
  ...["task", "mast", "selected", "show", "target", "relief", "contours", "draw", "at"],
  ...["turbine", "part", "viewpoint", "area", "candidates", "served", "choice", "site"],
  ...SITING.map(([name]) => name),
];
const TASKS = ["masts", "turbines", "sites", "premises"];
const SHOWS = ["together", "alone", "difference"];
const RELIEFS = ["shade", "slope", "none"];

/** @param {SceneState} state @returns {string} */
export function addressOf(state) {
  const fields = new URLSearchParams();
  if (state.task !== "masts") fields.set("task", state.task);
  for (const { x, y, height, hue, name } of state.masts) fields.append("mast", [x, y, height, hue, name].join(","));
  const selected = state.masts.findIndex((mast) => mast.id === state.selected);
  if (selected > 0) fields.set("selected", String(selected));
  if (state.show !== "together") fields.set("show", state.show);
  if (state.target) fields.set("target", targetText(state.target, state.masts));
  for (const [name, value] of Object.entries(state.options)) fields.set(name, value);
  if (state.layers.relief !== "shade") fields.set("relief", state.layers.relief);
  if (state.layers.contours) fields.set("contours", "on");
  fields.set("draw", state.layers.themes.join(","));
  addPlans(state, fields);
  if (state.view) fields.set("at", [state.view.x, state.view.y, state.view.resolution].join(","));
  return fields.toString().replaceAll("%2C", ",").replaceAll("%2F", "/").replaceAll("%3A", ":");
}

/** What is planned beside masts. @param {SceneState} state @param {URLSearchParams} fields */
function addPlans({ turbines, part, viewpoint, search, served, siting, plan }, fields) {
  for (const { x, y, hub, tip, name } of turbines) fields.append("turbine", [x, y, hub ?? "", tip, name].join(","));
  if (part !== "tips") fields.set("part", part);
  if (viewpoint) fields.set("viewpoint", `${viewpoint.x},${viewpoint.y}`);
  if (search && "ring" in search) fields.set("area", search.ring.join(","));
  if (search && "upload" in search) fields.set("candidates", fileText(search));
  if (served.kind !== "reach") fields.set("served", servedText(served));
  for (const [name, field] of SITING) if (siting[field] !== FIRST_SITING[field]) fields.set(name, siting[field]);
  if (!plan) return;
  fields.set("choice", plan.job.id);
  plan.sites.forEach((site, i) => isMoved(site) && fields.append("site", [i, site.x, site.y].join(",")));
}

/** A file that was sent: the server's name for it, and the planner's. @param {{upload: string, file: string}} sent */
const fileText = ({ upload, file }) => `${upload},${file}`;

/** An area, a file, or the word for either where it is not there yet. @param {import("./served.js").Served} served */
function servedText(served) {
  if (served.kind === "area" && served.ring) return served.ring.join(",");
  return served.kind === "places" && served.upload ? fileText(served) : served.kind;
}

/** @param {string} text @param {number} count @returns {number[] | null} that many numbers, or null */
function numbers(text, count) {
  const values = text.split(",", count).map(Number);
  return values.length === count && values.every(Number.isFinite) ? values : null;
}

/** @param {string} text @param {number} id @returns {Mast[]} the mast, or none where the text is not one */
function readMast(text, id) {
  const values = numbers(text, 4);
  if (!values) return [];
  const [x, y, height, hue] = values;
  return [{ id, hue: Math.abs(Math.trunc(hue)) % 8, x, y, height, name: text.split(",").slice(4).join(",") }];
}

/** @param {string} text @param {number} id @returns {Turbine[]} the turbine, or none where the text is not one */
function readTurbine(text, id) {
  const values = numbers(text, 4);
  if (!values) return [];
  const [x, y, hub, tip] = values;
  const parts = text.split(",");
  return [{ id, x, y, hub: parts[2] === "" ? null : hub, tip, name: parts.slice(4).join(",") }];
}

/** @param {string} text @returns {{ring: number[]} | null} */
function readArea(text) {
  const ring = numbers(text, text.split(",").length);
  return ring && ring.length >= 6 && ring.length % 2 === 0 ? { ring } : null;
}

/** A file that was sent, as far as its address tells: by the server's name and its own. @param {string} text
 * @returns {{upload: string, file: string, places: [], rings: [], rows: number} | null} */
function readFile(text) {
  const [, upload, file] = /^(upload-[^,]+),(.*)$/.exec(text) ?? [];
  return upload ? { upload, file, places: [], rings: [], rows: 0 } : null;
}

/** @param {string} text @returns {import("./served.js").Served} */
function readServed(text) {
  const kind = SERVED_KINDS.find((some) => some === text);
  if (kind) return servedOf(kind);
  const file = readFile(text);
  if (file) return { kind: "places", ...file };
  const area = readArea(text);
  return area ? { kind: "area", ...area } : { kind: "reach" };
}

/** The choice of sites that the address names, and where sites stand that were moved by hand.
 * @param {string} text @returns {{job: string, moved: {site: number, x: number, y: number}[]} | null} */
export function readChoice(text) {
  const fields = new URLSearchParams(text);
  const job = fields.get("choice");
  const moved = fields.getAll("site").flatMap((place) => {
    const values = numbers(place, 3);
    return values ? [{ site: values[0], x: values[1], y: values[2] }] : [];
  });
  return job ? { job, moved } : null;
}

/** @param {URLSearchParams} fields @returns {Partial<SceneState>} */
function readPlans(fields) {
  const turbines = fields.getAll("turbine").slice(0, MOST_TURBINES).flatMap(readTurbine);
  const viewpoint = numbers(fields.get("viewpoint") ?? "", 2);
  return {
    turbines,
    turbine: turbines[0]?.id ?? null,
    part: fields.get("part") === "hubs" ? "hubs" : "tips",
    viewpoint: viewpoint && { x: viewpoint[0], y: viewpoint[1] },
    search: readArea(fields.get("area") ?? "") ?? readFile(fields.get("candidates") ?? ""),
    served: readServed(fields.get("served") ?? ""),
    siting: /** @type {SceneState["siting"]} */ (
      Object.fromEntries(SITING.map(([name, field]) => [field, fields.get(name) ?? FIRST_SITING[field]]))
    ),
  };
}

/**
 * A place, or `mast:1` for the second mast.
 * @param {Target} target
 * @param {Mast[]} masts
 */
const targetText = (target, masts) =>
  "mast" in target ? `mast:${masts.findIndex(({ id }) => id === target.mast)}` : `${target.x},${target.y}`;

/** @param {string} text @param {Mast[]} masts @returns {Target | null} */
function readTarget(text, masts) {
  const mast = masts[Number(text.match(/^mast:(\d)$/)?.[1] ?? -1)];
  const place = numbers(text, 2);
  return mast ? { mast: mast.id } : place && { x: place[0], y: place[1] };
}

/**
 * Reads what the address says, and leaves the rest of the state as it is.
 * @param {string} text @param {SceneState} state @returns {SceneState}
 */
export function readAddress(text, state) {
  const fields = new URLSearchParams(text);
  const masts = fields.getAll("mast").slice(0, 8).flatMap(readMast);
  const at = numbers(fields.get("at") ?? "", 3);
  const show = fields.get("show") ?? "";
  const relief = fields.get("relief") ?? "";
  const draw = fields.get("draw");
  const options = [...fields].filter(([name]) => !OF_THE_PAGE.includes(name));
  const task = fields.get("task") ?? "";
  return {
    ...state,
    ...readPlans(fields),
    task: TASKS.includes(task) ? /** @type {SceneState["task"]} */ (task) : state.task,
    masts,
    selected: masts[Number(fields.get("selected"))]?.id ?? masts[0]?.id ?? null,
    show: SHOWS.includes(show) ? /** @type {SceneState["show"]} */ (show) : state.show,
    target: readTarget(fields.get("target") ?? "", masts),
    options: fields.size > 0 ? Object.fromEntries(options) : state.options,
    layers: {
      relief: RELIEFS.includes(relief) ? /** @type {SceneState["layers"]["relief"]} */ (relief) : state.layers.relief,
      contours: fields.has("contours"),
      themes: draw === null ? state.layers.themes : draw.split(",").filter((name) => name !== ""),
    },
    view: at && at[2] > 0 ? { x: at[0], y: at[1], resolution: at[2] } : state.view,
  };
}
