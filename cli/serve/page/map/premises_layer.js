// How each building was served when the buildings were last surveyed: a dot at the place of its best link.

import { Circle, Feature, Fill, Stroke, Style, VectorLayer, VectorSource } from "../vendor/ol.js";
import { SERVICES } from "../state/premises.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../state/premises.js").Building} Building */

const PIXELS = 5;
const EDGE = new Stroke({ color: "#fff", width: 1.5 });
const FILLS = new Map(SERVICES.map(({ service, colour }) => [service, new Fill({ color: colour })]));

/** @param {Building} building */
function dotOf({ x, y, service }) {
  const dot = new Feature(new Circle([x, y], 1));
  dot.setStyle(
    (_, resolution) =>
      new Style({ geometry: new Circle([x, y], PIXELS * resolution), fill: FILLS.get(service), stroke: EDGE }),
  );
  return dot;
}

export class PremisesLayer extends VectorLayer {
  /** @param {Scene} scene */
  constructor(scene) {
    const source = new VectorSource();
    super({ source });
    scene.on(["premises"], () => {
      source.clear(true);
      source.addFeatures((scene.state.premises ?? []).map(dotOf));
    });
    scene.on(["task"], () => this.setVisible(scene.state.task === "premises"));
  }
}
