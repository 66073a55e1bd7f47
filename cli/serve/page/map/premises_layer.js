// How each building was served when the buildings were last surveyed: a dot at the place of its best link.

import { Fill, Stroke, VectorLayer, VectorSource } from "../vendor/ol.js";
import { SERVICES } from "../state/premises.js";
import { dotAt } from "./dot.js";

/** @typedef {import("../state/scene.js").Scene} Scene */

const PIXELS = 5;
const EDGE = new Stroke({ color: "#fff", width: 1.5 });
const FILLS = new Map(SERVICES.map(({ service, colour }) => [service, new Fill({ color: colour })]));

export class PremisesLayer extends VectorLayer {
  /** @param {Scene} scene */
  constructor(scene) {
    const source = new VectorSource();
    super({ source });
    scene.on(["premises"], () => {
      source.clear(true);
      source.addFeatures(
        (scene.state.premises ?? []).map((building) => dotAt(building, PIXELS, FILLS.get(building.service), EDGE)),
      );
    });
    scene.on(["task"], () => this.setVisible(scene.state.task === "premises"));
  }
}
