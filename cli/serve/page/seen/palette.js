// Colours of masts and of classes of values. They differ for those who tell few colours apart (after Okabe and Ito, and
// viridis), on light and on dark relief.

/** @typedef {[number, number, number]} Rgb */

/** @type {Rgb[]} */
export const HUES = [
  [0, 114, 178],
  [213, 94, 0],
  [0, 150, 110],
  [190, 80, 160],
  [200, 150, 0],
  [60, 165, 225],
  [120, 80, 200],
  [110, 110, 60],
];
/** @type {Rgb} */
export const SHARED = [70, 70, 80];
/** Brighter than any mixture of the hues above can be. @type {Rgb} */
export const UNDECIDED_COLOUR = [255, 225, 60];
export const UNDECIDED_OPACITY = 0.7;

/** @type {Rgb[]} */
const RAMP = [
  [253, 231, 37],
  [160, 218, 57],
  [74, 193, 109],
  [31, 161, 135],
  [39, 127, 142],
  [54, 92, 141],
  [70, 50, 127],
  [68, 1, 84],
];

/** @param {number} hue @returns {string} */
export const hueCss = (hue) => cssColour(HUES[hue % HUES.length]);

/** @param {Rgb} colour */
export const cssColour = ([red, green, blue]) => `rgb(${red} ${green} ${blue})`;

/** The colour of class `i` of `count`, the best class first. @param {number} i @param {number} count @returns {Rgb} */
export function rampColour(i, count) {
  const at = count > 1 ? (i / (count - 1)) * (RAMP.length - 1) : 0;
  const low = Math.floor(at);
  const high = Math.min(low + 1, RAMP.length - 1);
  return /** @type {Rgb} */ (
    RAMP[low].map((from, channel) => Math.round(from + (at - low) * (RAMP[high][channel] - from)))
  );
}

/** @param {Rgb[]} colours @returns {Rgb} */
export function meanColour(colours) {
  return /** @type {Rgb} */ (
    [0, 1, 2].map((channel) =>
      Math.sqrt(colours.reduce((sum, colour) => sum + colour[channel] ** 2, 0) / colours.length),
    )
  );
}
