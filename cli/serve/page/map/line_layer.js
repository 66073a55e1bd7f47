// What is drawn over the map with lines: how far each mast looks, the line of sight, and the place on it that the
// profile's cursor points at.

import { Circle, Feature, Fill, LineString, Stroke, Style, VectorLayer, VectorSource } from "../vendor/ol.js";
import { hueCss } from "../seen/palette.js";
import { viewerOf, viewersOf } from "../seen/viewers.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../state/scene.js").Place} Place */

const CASING = new Stroke({ color: "rgb(255 255 255 / 0.85)", width: 5 });
const POINT_PIXELS = 6;

/** @param {Place} place */
const at = ({ x, y }) => [x, y];

export class LineLayer extends VectorLayer {
  #point = new Feature();

  /** @param {Scene} scene */
  constructor(scene) {
    super({ source: new VectorSource() });
    this.#point.setStyle(
      (_, resolution) =>
        new Style({
          geometry: () => new Circle(/** @type {any} */ (this.#point.get("at")) ?? [0, 0], POINT_PIXELS * resolution),
          fill: new Fill({ color: "#fff" }),
          stroke: new Stroke({ color: "#222", width: 2 }),
          zIndex: 2,
        }),
    );
    scene.on(["masts", "selected", "target", "options", "task", "plan"], () => this.#draw(scene));
  }

  /** Marks a place, or none. @param {Place | null} place */
  mark(place) {
    this.#point.set("at", place && at(place));
    this.#point.setGeometry(place ? new Circle(at(place), 1) : undefined);
  }

  /** @param {Scene} scene */
  #draw(scene) {
    const { options } = scene.state;
    const masts = viewersOf(scene.state);
    const chosen = viewerOf(scene.state);
    const end = scene.farEnd;
    const source = /** @type {VectorSource} */ (this.getSource());
    source.clear(true);
    const radius = Number(options.radius);
    for (const mast of masts) {
      if (!(radius > 0)) break;
      const circle = new Feature(new Circle(at(mast), radius));
      circle.setStyle(
        new Style({
          stroke: new Stroke({ color: hueCss(mast.hue), width: mast === chosen ? 2 : 1, lineDash: [6, 5] }),
        }),
      );
      source.addFeature(circle);
    }
    if (scene.mast && end) {
      const line = new Feature(new LineString([at(scene.mast), at(end)]));
      line.setStyle([
        new Style({ stroke: CASING }),
        new Style({ stroke: new Stroke({ color: hueCss(scene.mast.hue), width: 2.5 }) }),
      ]);
      source.addFeature(line);
    }
    source.addFeature(this.#point);
  }
}
