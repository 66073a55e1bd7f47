// Buildings as they were served when they were last surveyed.

/**
 * @typedef {object} Building
 * @property {string} name     Its theme, and its own name or number.
 * @property {string} service  One of SERVICES.
 * @property {string} how      From where on it and by which mast, or what is in the way; may be empty.
 * @property {number} x        The place of its best link.
 * @property {number} y
 */

/** What a survey says of a building, in the colours of its map on paper. */
export const SERVICES = [
  { service: "wall", colour: "rgb(0 114 178)", text: "served on a wall" },
  { service: "roof", colour: "rgb(0 158 115)", text: "served on the roof alone" },
  { service: "undecided", colour: "rgb(140 140 140)", text: "undecided" },
  { service: "not served", colour: "rgb(150 30 30)", text: "not served" },
];

/** @param {Record<string, string>} row  Of premises.csv. */
function howOf({ service, mast, height_m, blocked_by, blocking_feature, blocked_by_itself }) {
  if (service === "wall" || service === "roof") return `by ${mast}, from ${Number(height_m)} m up`;
  if (blocked_by_itself === "yes") return "hidden by itself";
  if (blocked_by === "terrain") return "hidden by the ground";
  return blocked_by ? `hidden by ${[blocked_by, blocking_feature].filter(Boolean).join(", ")}` : "";
}

/** The buildings within reach. @param {Record<string, string>[]} rows  Of premises.csv. @returns {Building[]} */
export const buildingsOf = (rows) =>
  rows
    .filter(({ x, y }) => x !== "" && y !== "")
    .map((row) => ({
      name: `${row.theme}, ${row.name}`,
      service: row.service,
      how: howOf(row),
      x: Number(row.x),
      y: Number(row.y),
    }));
