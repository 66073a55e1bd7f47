// Who sees, in each task: masts, sites that were chosen, or everybody who sees turbines; and what of that the map shows.

import { countingIn, withMode } from "../state/mode.js";
import { countMode, valueModeOf } from "./values.js";

/** @typedef {import("../state/scene.js").SceneState} SceneState */
/** @typedef {import("../state/scene.js").Mast} Mast */
/** @typedef {{id: number, options: Record<string, string>, observer: string | string[]}} Wanted
 *    A view that the server is asked for. */

/** The views of turbines: of their blade tips, and of their hubs. */
export const TIPS = 16;
export const HUBS = 17;

// Options that mean nothing where turbines are counted.
const OF_MASTS = ["mode", "frequency", "fresnel", "loss", "polarisation", "vertical-error", "target-on", "observer-on"];

/** The observer as the command line takes it. @param {{x: number, y: number, height: number}} mast */
export const observerOf = ({ x, y, height }) => `${x},${y},${height}`;

/** @param {Record<string, string>} options @param {string[]} names */
const without = (options, names) =>
  Object.fromEntries(Object.entries(options).filter(([name]) => !names.includes(name)));

/** Options of a view, as the task has them. @param {SceneState} state */
export function optionsOf({ task, options }) {
  if (task === "turbines") return { ...without(options, OF_MASTS), mode: "count" };
  // Sites know nothing of values.
  return countingIn(task === "sites" ? withMode(options, "visible") : options);
}

/** Masts, or sites: what stands on the map and sees. @param {SceneState} state @returns {Mast[]} */
export function viewersOf({ task, masts, plan }) {
  if (task === "turbines") return [];
  return task === "sites" ? (plan?.sites ?? []) : masts;
}

/** The one of them that is selected. @param {SceneState} state @returns {Mast | null} */
export function viewerOf(state) {
  const selected = state.task === "sites" ? state.plan?.selected : state.selected;
  return viewersOf(state).find(({ id }) => id === selected) ?? null;
}

/** How the masts are shown: sites are always shown together. @param {SceneState} state */
export const showOf = ({ task, show }) => (task === "sites" ? "together" : show);

/** The mode with values that the map shows, or null. @param {SceneState} state */
export function modeOf(state) {
  if (state.task !== "turbines") return valueModeOf(optionsOf(state));
  const hubs = state.part === "hubs";
  const counted = hubs ? state.turbines.filter(({ hub }) => hub !== null) : state.turbines;
  return countMode(counted.length, hubs ? "hub" : "blade tip");
}

/** @param {SceneState} state @returns {Wanted[]} */
export function wantedOf(state) {
  const options = optionsOf(state);
  const { task, turbines } = state;
  if (task !== "turbines") {
    return viewersOf(state).map((mast) => ({ id: mast.id, options, observer: observerOf(mast) }));
  }
  const tips = turbines.map(({ x, y, tip }) => observerOf({ x, y, height: tip }));
  const hubs = turbines.flatMap(({ x, y, hub }) => (hub === null ? [] : [observerOf({ x, y, height: hub })]));
  return [
    { id: TIPS, options, observer: tips },
    { id: HUBS, options, observer: hubs },
  ].filter(({ observer }) => observer.length > 0);
}
