// What the line of sight comes to, in words.

import { azimuthsText, distanceText, metresText, numberText, placeText } from "../panel/words.js";

/** @typedef {import("./sight_line.js").SightLine} SightLine */

/** @param {{theme: string, feature?: string | null}} what */
export const obstacleText = ({ theme, feature }) =>
  theme === "terrain" ? "the ground" : [theme, feature].filter(Boolean).join(", ");

/** @param {SightLine} line @returns {string} */
export function verdictWords(line) {
  if (line.verdict === "visible") return "In sight";
  if (line.verdict === "undecided") return "Undecided: ground without data lies on the line";
  const worst = line.obstructions.reduce(
    (most, some) => (some.depth_m > most.depth_m ? some : most),
    line.obstructions[0],
  );
  if (!worst) return "Hidden";
  const where = `${metresText(worst.depth_m)} above the line ${distanceText(worst.peak_at_m)} away`;
  return `Hidden by ${obstacleText(worst)}, ${where}`;
}

/** @param {{clearance_m: number, distance_m: number}} tightest */
const tightestText = ({ clearance_m, distance_m }) =>
  `${metresText(clearance_m)} over the surface, ${distanceText(distance_m)} away`;

/** @param {{ld: number, free_space: number}} losses */
const lossText = ({ ld, free_space }) =>
  `${numberText(free_space, 1)} dB free space, ${numberText(ld, 1)} dB diffraction`;

/** What else a planner asks of a line. @param {SightLine} line @returns {[string, string][]} */
export function lineFacts(line) {
  const { from, to, radio } = line;
  const needed = line.required_heights?.[0];
  /** @type {[string, string][]} */
  const facts = [
    ["Distance", distanceText(line.distance_m)],
    ["Azimuth", azimuthsText(from.azimuth_grid_deg, from.azimuth_true_deg)],
    ["Back", azimuthsText(to.azimuth_grid_deg, to.azimuth_true_deg)],
  ];
  if (line.tightest) facts.push(["Clearance", tightestText(line.tightest)]);
  if (line.verdict === "hidden" && needed) {
    if (needed.from_alone_m !== null) facts.push(["Mast height needed", metresText(needed.from_alone_m)]);
    if (needed.to_alone_m !== null) facts.push(["Target height needed", metresText(needed.to_alone_m)]);
  }
  if (radio?.fresnel_fraction !== null && radio?.fresnel_fraction !== undefined) {
    facts.push(["Fresnel zone", `least clearance ${numberText(radio.fresnel_fraction, 2)} F1`]);
  }
  if (radio?.losses_db) facts.push(["Loss", lossText(radio.losses_db)]);
  const degrees = Number.isFinite(to.lat) ? ` (${numberText(to.lat, 5)}, ${numberText(to.lon, 5)})` : "";
  facts.push(["Target at", `${placeText(to.x, to.y)}${degrees}`]);
  return facts;
}
