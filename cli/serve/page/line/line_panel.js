// The panel of the line of sight: its verdict, its facts and its profile, tied to the map both ways.

import { ProfileChart } from "./profile_chart.js";
import { lineFacts, verdictWords } from "./line_words.js";
import { followSightLine } from "./sight_line.js";
import { keepingPlace } from "../map/keeping_place.js";
import { element, make } from "../panel/elements.js";
import { inPageWords } from "../panel/page_words.js";

/** @typedef {import("../state/scene.js").Scene} Scene */

const NEAR_PIXELS = 14;

/** How far along a line a place lies, and how far beside it. @param {{x: number, y: number}} from
 * @param {{x: number, y: number}} to @param {number[]} place */
function alongLine(from, to, [x, y]) {
  const length = Math.hypot(to.x - from.x, to.y - from.y);
  const east = (to.x - from.x) / length;
  const north = (to.y - from.y) / length;
  const along = (x - from.x) * east + (y - from.y) * north;
  return { share: along / length, beside: Math.abs((x - from.x) * north - (y - from.y) * east) };
}

const capital = (/** @type {string} */ text) => text.replace(/^./, (letter) => letter.toUpperCase());

/** Who sees whom, or what hides it. @param {Scene} scene @param {import("./sight_line.js").SightLine} line */
function verdictOf({ mast, farEnd }, line) {
  const ends = [mast?.name, farEnd?.name].filter(Boolean).join(" to ");
  return `${ends}: ${verdictWords(line).replace(/^./, (letter) => letter.toLowerCase())}`;
}

/**
 * @param {Scene} scene @param {import("../server/live_connection.js").LiveConnection} connection
 * @param {import("../vendor/ol.js").OlMap} map
 * @param {import("../map/line_layer.js").LineLayer} layer
 * @param {MediaQueryList} dark
 */
export function makeLinePanel(scene, connection, map, layer, dark) {
  const panel = element("line");
  const verdict = element("line-verdict");
  const facts = element("line-facts");
  const chart = new ProfileChart(element("profile"), dark, (place) => layer.mark(place));
  let length = 0;
  element("line-close").addEventListener("click", () => scene.change({ target: null }));
  followSightLine(
    scene,
    connection,
    () => (panel.ariaBusy = "true"),
    (line, error, newest) => {
      panel.ariaBusy = String(!newest);
      const fill = () => {
        panel.hidden = line === null && error === "";
        verdict.textContent = line ? verdictOf(scene, line) : capital(inPageWords(error));
        verdict.dataset.verdict = line?.verdict ?? "";
        facts.replaceChildren(...(line ? lineFacts(line) : []).map(factElement));
      };
      // The panel is as high as what it says. A page that opens with a line has its map where it was left.
      const opens = !panel.hidden && verdict.textContent === "";
      if (opens) fill();
      else keepingPlace(map, scene.farEnd, fill);
      length = line?.distance_m ?? 0;
      chart.show(line, scene.mast?.hue ?? 0);
      if (!line) layer.mark(null);
    },
  );
  map.on("pointermove", ({ coordinate }) => {
    const mast = scene.mast;
    const end = scene.farEnd;
    if (!mast || !end || length === 0) return;
    const { share, beside } = alongLine(mast, end, coordinate);
    const near = share >= 0 && share <= 1 && beside < NEAR_PIXELS * (map.getView().getResolution() ?? 1);
    chart.point(near ? share * length : null);
  });
}

/** @param {[string, string]} fact */
function factElement([name, value]) {
  const group = make("div");
  group.append(make("dt", "", name), make("dd", "", value));
  return group;
}
