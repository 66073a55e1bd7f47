// Numbers as a planner reads them.

const MINUS = "−";
const NARROW = " ";

/** @param {number} value @param {number} [digits] */
export function numberText(value, digits = 0) {
  return value
    .toLocaleString("en-GB", { minimumFractionDigits: digits, maximumFractionDigits: digits })
    .replaceAll(",", NARROW)
    .replace("-", MINUS);
}

/** A height or a short length. @param {number} metres */
export const metresText = (metres) =>
  `${numberText(metres, Math.abs(metres) < 100 && !Number.isInteger(metres) ? 1 : 0)} m`;

/** @param {number} metres */
export const distanceText = (metres) =>
  metres < 1000 ? `${numberText(metres)} m` : `${numberText(metres / 1000, 2)} km`;

/** A length that somebody chose. @param {number} metres */
export const chosenText = (metres) => (metres < 1000 ? `${metres} m` : `${metres / 1000} km`);

/** @param {number} degrees */
const azimuthText = (degrees) => `${numberText(degrees, 1).padStart(5, "0")}°`;

/** @param {number} squareMetres */
export function areaText(squareMetres) {
  if (squareMetres === 0) return "nothing";
  if (squareMetres < 1e4) return `${numberText(squareMetres)} m²`;
  if (squareMetres < 1e6) return `${numberText(squareMetres / 1e4, 1)} ha`;
  return `${numberText(squareMetres / 1e6, squareMetres < 1e8 ? 1 : 0)} km²`;
}

/** @param {number} part @param {number} whole */
export const shareText = (part, whole) => (whole > 0 ? `${numberText((100 * part) / whole, 1)} %` : "–");

/** @param {number} x @param {number} y */
export const placeText = (x, y) => `${numberText(x)} E ${numberText(y)} N`;

/** @param {number} lon @param {number} lat */
export const degreesText = (lon, lat) =>
  `${numberText(Math.abs(lat), 5)}${lat < 0 ? "S" : "N"} ${numberText(Math.abs(lon), 5)}${lon < 0 ? "W" : "E"}`;

/** An azimuth from grid north, and from true north where that is known. @param {number} grid @param {number | null} north */
export const azimuthsText = (grid, north) =>
  `${azimuthText(grid)} grid${north === null ? "" : `, ${azimuthText(north)} true`}`;

/** What went wrong, in the words of who says so. @param {unknown} problem */
export const messageOf = (problem) => (problem instanceof Error ? problem.message : String(problem));

/** @param {number} count @param {string} what */
export const countedText = (count, what) => `${numberText(count)} ${what}${count === 1 ? "" : "s"}`;
