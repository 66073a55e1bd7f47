// Numbers as a planner reads them.

const MINUS = "−", NARROW = " ";

/** @param {number} value @param {number} [digits] */
export function numberText(value, digits = 0) {
  return value.toLocaleString("en-GB", { minimumFractionDigits: digits, maximumFractionDigits: digits }).replaceAll(",", NARROW).replace("-", MINUS);
}

/** A height or a short length. @param {number} metres */
export const metresText = (metres) => `${numberText(metres, Math.abs(metres) < 100 && !Number.isInteger(metres) ? 1 : 0)} m`;

/** @param {number} metres */
export const distanceText = (metres) => (metres < 1000 ? `${numberText(metres)} m` : `${numberText(metres / 1000, 2)} km`);

/** @param {number} degrees */
export const azimuthText = (degrees) => `${numberText(degrees, 1).padStart(5, "0")}°`;

/** @param {number} square_metres */
export function areaText(square_metres) {
  if (square_metres === 0) return "nothing";
  if (square_metres < 1e4) return `${numberText(square_metres)} m²`;
  if (square_metres < 1e6) return `${numberText(square_metres / 1e4, 1)} ha`;
  return `${numberText(square_metres / 1e6, square_metres < 1e8 ? 1 : 0)} km²`;
}

/** @param {number} part @param {number} whole */
export const shareText = (part, whole) => (whole > 0 ? `${numberText((100 * part) / whole, 1)} %` : "–");

/** @param {number} x @param {number} y */
export const placeText = (x, y) => `${numberText(x)} E ${numberText(y)} N`;
