// The line of sight from the mast selected to the target: asked for anew as either moves.

import { observerOf } from "../seen/viewers.js";
import { neededIn } from "../state/mode.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../server/live_connection.js").LiveConnection} LiveConnection */
/**
 * @typedef {object} Profile
 * @property {number[]} distance_m @property {number[]} surface_m @property {(number | null)[]} ground_m
 * @property {number[]} x @property {number[]} y @property {number[]} ray_m @property {number[]} curvature_m
 * @property {(number | null)[] | null} fresnel_m  Null without a frequency.
 */
/** @typedef {{name: string, from_alone_m: number | null, to_alone_m: number | null}} RequiredHeights */
/**
 * @typedef {{from_m: number, to_m: number, peak_at_m: number, depth_m: number, theme: string, feature: string | null}}
 *   Obstruction
 */
/**
 * @typedef {{x: number, y: number, ground_m: number, height_m: number, lon: number, lat: number, azimuth_grid_deg:
 *   number, azimuth_true_deg: number | null}} LineEnd
 */
/**
 * @typedef {object} SightLine
 * @property {"visible" | "hidden" | "undecided"} verdict
 * @property {number} distance_m
 * @property {{distance_m: number, clearance_m: number} | null} tightest
 * @property {LineEnd} from @property {LineEnd} to
 * @property {Obstruction[]} obstructions
 * @property {RequiredHeights[]} required_heights
 * @property {{fresnel_fraction: number | null, losses_db?: {ld: number, free_space: number}} | null} [radio]
 * @property {Profile} profile
 */

// Those options of a viewshed that a single line has, too.
const SHARED = [
  "themes",
  "tolerance",
  "nodata",
  "curvature",
  "refraction",
  "earth-radius",
  "effective-earth",
  "frequency",
  "polarisation",
  "over-sea",
  "target-on",
  "observer-on",
];
const LINE = 1;

/** Both ends of a line between masts stand as masts do. @param {Scene} scene @param {{name: string}} end */
function optionsOf({ state: { options } }, end) {
  const given = { ...neededIn(options), ...options };
  const shared = Object.fromEntries(Object.entries(given).filter(([name]) => SHARED.includes(name)));
  return end.name ? { ...shared, "target-on": options["observer-on"] ?? "ground" } : shared;
}

/**
 * @param {Scene} scene @param {LiveConnection} connection
 * @param {() => void} asks  Called when a newer line is asked for.
 * @param {(line: SightLine | null, error: string, newest: boolean) => void} take  Gets each answer, or null where there
 *   is no line, and whether it is to what was asked last.
 */
export function followSightLine(scene, connection, asks, take) {
  let asked = "";
  let seq = 0;
  const ask = () => {
    const mast = scene.mast;
    const end = scene.farEnd;
    const wanted = mast &&
      end && { ...optionsOf(scene, end), from: observerOf(mast), to: `${end.x},${end.y},${end.height}` };
    const text = JSON.stringify(wanted);
    if (text === asked) return;
    asked = text;
    if (!wanted) return take(null, "", true);
    asks();
    connection.send({ type: "line", id: LINE, seq: ++seq, options: wanted });
  };
  connection.on("welcome", () => {
    asked = "";
    ask();
  });
  connection.on("line", (message) => asked !== "null" && take(/** @type {any} */ (message), "", message.seq === seq));
  connection.on("error", (message) => message.of === "line" && message.seq === seq && take(null, message.error, true));
  scene.on(["masts", "selected", "target", "options", "task"], ask);
}
