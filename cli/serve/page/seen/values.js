// What the modes with a value for each cell show: classes between limits, the best class first.

import { modeNamed } from "../state/mode.js";

/**
 * @typedef {object} ValueMode
 * @property {string} title
 * @property {string} short             What the readout calls the value.
 * @property {string} unit
 * @property {number[]} limits          Where the next class begins.
 * @property {"least" | "greatest"} best  Which of several masts' values counts.
 * @property {number} [whole]           Values are whole numbers from 1 to this.
 */

/** @type {Record<string, ValueMode>} */
export const VALUE_MODES = {
  height: {
    short: "Seen from",
    title: "Height from which it is seen",
    unit: "m",
    limits: [2, 5, 10, 20, 50, 100],
    best: "least",
  },
  angle: {
    short: "Angle",
    title: "Angle of sight above the level",
    unit: "°",
    limits: [2, 1, 0.5, 0, -0.5, -1, -2],
    best: "greatest",
  },
  probability: {
    short: "Probability",
    title: "Probability of being seen",
    unit: "",
    limits: [0.95, 0.8, 0.6, 0.4, 0.2, 0.05],
    best: "greatest",
  },
  loss: { short: "Loss", title: "Loss by diffraction", unit: "dB", limits: [1, 3, 6, 10, 20, 30], best: "least" },
};

/** The mode with values that the options ask for, or null. @param {Record<string, string>} options */
export const valueModeOf = (options) => VALUE_MODES[modeNamed(options)] ?? null;

const MOST_BANDS = 7;

/** How many of `most` turbines are seen: bands of equal width, the most first. @param {number} most
 * @param {string} what @returns {ValueMode} */
export function countMode(most, what) {
  const width = Math.max(1, Math.ceil(most / MOST_BANDS));
  const limits = [];
  for (let limit = width * Math.floor((most - 1) / width) + 1; limit > 1; limit -= width) limits.push(limit);
  const title = `${what[0].toUpperCase()}${what.slice(1)}s seen`;
  return { title, short: title, unit: "", limits, best: "greatest", whole: most };
}

/** The class of a value, from 0. @param {ValueMode} mode @param {number} value */
export function classOf({ limits, best }, value) {
  const least = best === "least";
  let at = 0;
  while (at < limits.length && (least ? value > limits[at] : value < limits[at])) ++at;
  return at;
}

/** @param {string} number @param {string} unit */
export const withUnit = (number, unit) => `${number}${unit && unit !== "°" ? " " : ""}${unit}`;

/** What class `at` is called. @param {ValueMode} mode @param {number} at */
export function className(mode, at) {
  const { limits, unit, best, whole } = mode;
  if (whole) return bandName(limits[at] ?? 1, (limits[at - 1] ?? whole + 1) - 1);
  const text = (/** @type {number} */ limit) => withUnit(String(limit).replace("-", "−"), unit);
  if (at === 0) return `${best === "least" ? "up to" : "over"} ${text(limits[0])}`;
  if (at === limits.length) return `${best === "least" ? "over" : "under"} ${text(limits[at - 1])}`;
  return `${text(limits[at - 1])} to ${text(limits[at])}`;
}

/** @param {number} from @param {number} to */
const bandName = (from, to) => (from === to ? String(from) : `${from} to ${to}`);
