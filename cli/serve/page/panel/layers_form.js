// What the map draws under what masts see: relief, contours, outlines of themes. These change no answer.

import { element, make } from "./elements.js";
import { metresText } from "./words.js";
import { contourInterval } from "../map/contours.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../state/scene.js").Layers} Layers */
/** @typedef {import("../server/api.js").Info} Info */

/** @param {Scene} scene @param {Info} info */
export function makeLayersForm(scene, info) {
  const relief = /** @type {HTMLSelectElement} */ (element("relief"));
  const contours = /** @type {HTMLInputElement} */ (element("contours"));
  const change = (/** @type {Partial<Layers>} */ parts) =>
    scene.change({ layers: { ...scene.state.layers, ...parts } });
  relief.addEventListener("change", () => change({ relief: /** @type {Layers["relief"]} */ (relief.value) }));
  contours.addEventListener("change", () => change({ contours: contours.checked }));
  const themes = info.tiles.themes.map((name) => {
    const label = make("label", "check");
    const input = make("input");
    input.type = "checkbox";
    input.addEventListener("change", () =>
      change({ themes: themes.filter((some) => some.input.checked).map((some) => some.name) }),
    );
    label.append(input, `Outlines: ${name}`);
    element("drawn-themes").append(label);
    return { name, input };
  });
  scene.on(["view"], () => {
    const { view } = scene.state;
    element("contour-interval").textContent = view
      ? `every ${metresText(contourInterval(view.resolution, info.tiles.resolutions.at(-1) ?? 1))}`
      : "";
  });
  scene.on(["layers"], () => {
    const { layers } = scene.state;
    relief.value = layers.relief;
    contours.checked = layers.contours;
    for (const { name, input } of themes) input.checked = layers.themes.includes(name);
  });
}
