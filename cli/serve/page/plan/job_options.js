// Which of the map's options a verb of the program takes, by its own names for them.

/** @typedef {Record<string, string>} Options */

const SURFACE = ["themes", "tolerance", "nodata", "curvature", "refraction", "earth-radius", "effective-earth"];

/** @type {Record<string, string[]>} */
const TAKEN = {
  ztv: ["radius", "cell", ...SURFACE],
  site: ["radius", "cell", "frequency", "fresnel", "target-on", "observer-on", ...SURFACE],
  dwellings: SURFACE.filter((name) => name !== "tolerance"),
  premises: ["radius", "frequency", "fresnel", "observer-on", ...SURFACE.filter((name) => name !== "tolerance")],
};
/** The map's targets are the eyes that look at turbines. @type {Record<string, string>} */
const TARGET_HEIGHT = { ztv: "observer-height", dwellings: "observer-height", site: "target-height" };

/** @param {string} verb @param {Options} options @returns {Options} */
export function jobOptions(verb, options) {
  const taken = Object.entries(options).filter(([name]) => TAKEN[verb].includes(name));
  const height = TARGET_HEIGHT[verb];
  return { ...Object.fromEntries(taken), ...(height ? { [height]: options["target-height"] ?? "0" } : {}) };
}
