// How far the map is, and what is wrong: one line over the map.

import { element } from "./elements.js";
import { inPageWords } from "./page_words.js";

/** @typedef {import("../server/live_connection.js").LiveConnection} LiveConnection */
/** @typedef {import("../seen/live_views.js").LiveViews} LiveViews */

const SHARES = /** @type {Record<number, string>} */ ({ 9: "1 in 81 decided", 3: "1 in 9 decided" });
const LINE_WORDS = {
  connecting: "",
  live: "",
  lost: "The server does not answer. Trying again …",
  refused:
    "This page has no key to the server that runs. Open the address that itin serve printed; in this tab, what is on the map stays.",
};

/** @param {LiveConnection} connection @param {LiveViews} views
 * @param {import("../map/height_tiles.js").HeightTiles} tiles */
export function makeStatus(connection, views, tiles) {
  const line = element("status");
  let lost = "";
  let ground = "";
  const show = () => {
    const found = views.all;
    // An error that is about no option is about the store or the server.
    const trouble = lost || found.find(({ error, field }) => error && !field)?.error || ground;
    const steps = found.filter((view) => view.cells && !view.done).map((view) => view.cells?.step ?? 1);
    const reading = found.some((view) => !view.cells && !view.error) ? "Reading the ground …" : "";
    line.textContent =
      inPageWords(trouble) ||
      (steps.length > 0 ? (SHARES[Math.max(...steps)] ?? "Deciding the last cells …") : reading);
    line.classList.toggle("problem", trouble !== "");
    line.hidden = line.textContent === "";
  };
  connection.onState = (state) => {
    lost = LINE_WORDS[state];
    show();
  };
  tiles.onProblem = (problem) => {
    ground = problem;
    show();
  };
  views.onChange(show);
}
