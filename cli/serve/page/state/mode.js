// What each place shows, and which of the options count there. The state keeps all that the planner has typed; what the
// mode has no use for is not asked of the server, which would refuse it.

/** @typedef {Record<string, string>} Options */

/** The modes in which an option counts, where it does not in all. @type {Record<string, string[]>} */
const COUNTS_IN = {
  "vertical-error": ["probability"],
  frequency: ["visible", "loss"],
  fresnel: ["visible"],
  polarisation: ["loss"],
};
/** What a mode needs, and takes where the planner has typed nothing. @type {Record<string, Options>} */
const NEEDED = { loss: { frequency: "5.8" }, probability: { "vertical-error": "1" } };

/** A loss is an option of its own on the command line. @param {Options} options */
export const modeNamed = ({ mode = "visible", loss }) => (loss ? "loss" : mode);

/** The options of a mode. @param {Options} options @param {string} mode @returns {Options} */
export function withMode({ mode: _mode, loss: _loss, ...others }, mode) {
  if (mode === "loss") return { ...others, loss: "true" };
  return mode === "visible" ? others : { ...others, mode };
}

/** What the mode of the options takes for a field that is empty. @param {Options} options @returns {Options} */
export const neededIn = (options) => NEEDED[modeNamed(options)] ?? {};

/** The options that count in their mode, and what it needs besides. @param {Options} options @returns {Options} */
export function countingIn(options) {
  const mode = modeNamed(options);
  const counting = Object.entries(withMode(options, mode)).filter(([name]) => COUNTS_IN[name]?.includes(mode) ?? true);
  return { ...neededIn(options), ...Object.fromEntries(counting) };
}
