// Pictures of the ground from its heights: hillshade from the north-west, as maps have it, or slope by classes.

/** @typedef {import("./height_tiles.js").HeightTile} HeightTile */
/** @typedef {{relief: "shade" | "slope" | "none", dark: boolean}} ReliefStyle */

// Light from the north-west, 45 degrees high, and some from above, so that slopes in shadow keep their form. Level
// ground
// has the middle tone.
const LIGHT = [-0.5, 0.5, Math.SQRT1_2];
const FROM_ABOVE = 0.25;
/** Where the next class of slope begins, degrees. */
export const SLOPE_LIMITS = [5, 10, 15, 20, 30, 40];
/** @type {[number, number, number][]} */
export const SLOPE_COLOURS = [
  [236, 240, 226],
  [214, 226, 178],
  [246, 226, 140],
  [240, 184, 100],
  [222, 124, 76],
  [176, 64, 66],
  [110, 30, 60],
];
const NO_GROUND = { light: [226, 228, 234], dark: [24, 27, 33] };
const PAPER = {
  light: { dark: [92, 96, 98], bright: [255, 254, 250] },
  // Far darker than any colour of what is seen over it.
  dark: { dark: [8, 10, 14], bright: [62, 67, 73] },
};

/** How much slopes are exaggerated: maps of large areas have gentle ones. @param {number} resolution */
const exaggeration = (resolution) => Math.min(5, Math.max(1.5, 1.5 * Math.pow(resolution / 5, 0.3)));

/**
 * @param {HeightTile} tile @param {number} size  pixels to a side of the picture
 * @param {number} resolution  metres a pixel @param {ReliefStyle} style @returns {ImageData}
 */
export function relief(tile, size, resolution, style) {
  const { heights, width } = tile;
  const border = (width - size) / 2;
  const image = new ImageData(size, size);
  const colour =
    style.relief === "shade" ? shader(resolution, style.dark) : style.relief === "slope" ? slopes : plain(style.dark);
  const nothing = style.dark ? NO_GROUND.dark : NO_GROUND.light;
  for (let y = 0, to = 0; y < size; ++y) {
    for (let x = 0; x < size; ++x, to += 4) {
      const at = (y + border) * width + x + border;
      const here = heights[at];
      const rgb = Number.isNaN(here)
        ? nothing
        : colour(slope(heights, at, 1, here) / resolution, slope(heights, at, -width, here) / resolution);
      image.data[to] = rgb[0];
      image.data[to + 1] = rgb[1];
      image.data[to + 2] = rgb[2];
      image.data[to + 3] = 255;
    }
  }
  return image;
}

/** The rise to the next pixel, from both neighbours that are known. @param {Float32Array} heights @param {number} at
 * @param {number} step @param {number} here */
function slope(heights, at, step, here) {
  const next = heights[at + step];
  const last = heights[at - step];
  if (Number.isNaN(next)) return Number.isNaN(last) ? 0 : here - last;
  return Number.isNaN(last) ? next - here : (next - last) / 2;
}

/** @typedef {(east: number, north: number) => ArrayLike<number>} ColourOfSlope  By what the ground rises to a metre. */

/** @param {number} resolution @param {boolean} dark @returns {ColourOfSlope} */
function shader(resolution, dark) {
  const { dark: low, bright } = dark ? PAPER.dark : PAPER.light;
  const factor = exaggeration(resolution);
  const rgb = [0, 0, 0];
  return (east, north) => {
    const e = factor * east;
    const n = factor * north;
    const length = Math.sqrt(1 + e * e + n * n);
    const direct = Math.max(0, (-e * LIGHT[0] - n * LIGHT[1] + LIGHT[2]) / length);
    const light = Math.min(1, (1 - FROM_ABOVE) * direct + FROM_ABOVE / length);
    for (let channel = 0; channel < 3; ++channel) {
      rgb[channel] = low[channel] + light * (bright[channel] - low[channel]);
    }
    return rgb;
  };
}

/** @param {number} east @param {number} north */
function slopes(east, north) {
  const degrees = (Math.atan(Math.hypot(east, north)) * 180) / Math.PI;
  const found = SLOPE_LIMITS.findIndex((limit) => degrees < limit);
  return SLOPE_COLOURS[found === -1 ? SLOPE_LIMITS.length : found];
}

/** @param {boolean} dark @returns {ColourOfSlope} */
function plain(dark) {
  const rgb = dark ? [52, 57, 64] : [244, 243, 238];
  return () => rgb;
}
