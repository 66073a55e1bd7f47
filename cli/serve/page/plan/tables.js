// Tables that the page sends and reads (CSV).

import { rotorOf } from "../state/turbines.js";

/** @param {(string | number | null)[]} cells */
const lineOf = (cells) =>
  cells.map((cell) => (typeof cell === "string" ? `"${cell.replaceAll('"', '""')}"` : (cell ?? ""))).join(",");

/** @param {string[]} columns @param {(string | number | null)[][]} rows */
export const tableOf = (columns, rows) => new Blob([`${[columns.join(","), ...rows.map(lineOf)].join("\n")}\n`]);

/** @param {import("../state/turbines.js").Turbine[]} turbines */
export const turbineTable = (turbines) =>
  tableOf(
    ["name", "x", "y", "hub_height", "rotor_diameter", "tip_height"],
    turbines.map(({ name, x, y, hub, tip }) => [name, x, y, hub, rotorOf({ hub, tip }), tip]),
  );

/** What a table has of masts. @param {import("../state/scene.js").Mast[]} masts */
export const mastRows = (masts) => masts.map(({ name, x, y, height }) => [name, x, y, height]);

/** @param {import("../state/scene.js").Mast[]} masts */
export const mastTable = (masts) => tableOf(["name", "x", "y", "height"], mastRows(masts));

/** The cells of a line, of which those with commas are quoted. @param {string} line */
const cellsOf = (line) =>
  [...line.matchAll(/("(?:[^"]|"")*"|[^,]*)(?:,|$)/g)].map(([, cell]) => cell.replace(/^"|"$/g, ""));

/** The rows of a table that the program wrote, by the names of its columns. @param {string} text
 * @returns {Record<string, string>[]} */
export function rowsIn(text) {
  const [head, ...lines] = text.trim().split(/\r?\n/).map(cellsOf);
  return lines.map((cells) => Object.fromEntries(head.map((name, i) => [name, cells[i]])));
}

/** The places in such a table. @param {string} text @returns {{x: number, y: number}[]} */
export const placesIn = (text) => rowsIn(text).map(({ x, y }) => ({ x: Number(x), y: Number(y) }));
