// Where sites are looked for, and the candidates: an area that is drawn on the map or was sent, and points; and what
// they are to serve.

import { Draw, Feature, Fill, Polygon, Stroke, Style, VectorLayer, VectorSource } from "../vendor/ol.js";
import { nearestPlace } from "../state/nearest.js";
import { closedCorners } from "../state/plan.js";
import { dotAt } from "./dot.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../vendor/ol.js").OlMap} OlMap */

const LINE = "rgb(27 31 36 / 0.9)";
const AREA = new Style({
  stroke: new Stroke({ color: LINE, width: 2, lineDash: [8, 5] }),
  fill: new Fill({ color: "rgb(255 255 255 / 0.12)" }),
});
const SERVED_LINE = "rgb(0 90 150 / 0.95)";
const SERVED_AREA = new Style({
  stroke: new Stroke({ color: SERVED_LINE, width: 2, lineDash: [2, 5], lineCap: "round" }),
  fill: new Fill({ color: "rgb(86 180 233 / 0.12)" }),
});
const SERVED_PIXELS = 2.5;
const CANDIDATE_PIXELS = 3.5;
/** How far from a candidate a click still means it, in pixels. */
const NEAR_PIXELS = 10;

/** What is to be served, as far as it is drawn or loaded. @param {import("../state/scene.js").SceneState} state */
const servedOf = ({ served }) => ({
  rings: served.kind === "area" && served.ring ? [served.ring] : [],
  places: served.kind === "places" ? served.places : [],
});

/** @param {number[][]} rings @param {Style} style */
const areasOf = (rings, style) =>
  rings.map((ring) => {
    const area = new Feature(new Polygon([closedCorners(ring)]));
    area.setStyle(style);
    return area;
  });

/** @param {{x: number, y: number}[]} places @param {number} pixels @param {Fill} fill @param {Stroke} stroke */
const pointsOf = (places, pixels, fill, stroke) => places.map((place) => dotAt(place, pixels, fill, stroke));

/** @param {import("../state/scene.js").SceneState} state @returns {{rings: number[][], places: {x: number, y: number}[]}} */
function searched({ search, plan }) {
  const rings = !search ? [] : "ring" in search ? [search.ring] : search.rings;
  return { rings, places: plan?.candidates ?? (search && "places" in search ? search.places : []) };
}

export class SearchLayer extends VectorLayer {
  /** @param {Scene} scene */
  constructor(scene) {
    super({ source: new VectorSource() });
    scene.on(["search", "served", "plan", "task"], () => this.#draw(scene));
  }

  /** @param {Scene} scene */
  #draw(scene) {
    const source = /** @type {VectorSource} */ (this.getSource());
    source.clear(true);
    this.setVisible(scene.state.task === "sites");
    const served = servedOf(scene.state);
    const { rings, places } = searched(scene.state);
    source.addFeatures([
      ...areasOf(served.rings, SERVED_AREA),
      ...areasOf(rings, AREA),
      ...pointsOf(
        served.places,
        SERVED_PIXELS,
        new Fill({ color: SERVED_LINE }),
        new Stroke({ color: "#fff", width: 1 }),
      ),
      ...pointsOf(places, CANDIDATE_PIXELS, new Fill({ color: "#fff" }), new Stroke({ color: LINE, width: 1.5 })),
    ]);
  }
}

/** The candidate that a click means, or null. @param {Scene} scene @param {OlMap} map @param {number[]} place */
export const candidateAt = (scene, map, place) =>
  nearestPlace(scene.state.plan?.candidates ?? [], place, NEAR_PIXELS * (map.getView().getResolution() ?? 1));

/** Lets the planner draw an area on the map, corner by corner, until it is closed or given up.
 * @param {OlMap} map @param {(ring: number[]) => void} take  Gets the area.
 * @param {() => void} end  Called when there is nothing more to draw.
 * @returns {() => void} takes the drawing off the map */
export function drawArea(map, take, end) {
  const draw = new Draw({ type: "Polygon" });
  draw.on("drawend", ({ feature }) => {
    const corners = /** @type {Polygon} */ (feature.getGeometry()).getCoordinates()[0].slice(0, -1);
    take(corners.flatMap(([x, y]) => [Math.round(x), Math.round(y)]));
    // The click that ends the drawing is still on its way to the map.
    setTimeout(end);
  });
  map.addInteraction(draw);
  return () => void map.removeInteraction(draw);
}
