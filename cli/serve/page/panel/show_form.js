// Whether several masts are shown together, one alone, or what it adds to the others.

import { element } from "./elements.js";

/** @typedef {import("../state/scene.js").Scene} Scene */

/** @param {Scene} scene */
export function makeShowForm(scene) {
  const inputs = /** @type {HTMLInputElement[]} */ ([...element("show").querySelectorAll("input")]);
  for (const input of inputs) {
    input.addEventListener("change", () => scene.change({ show: /** @type {any} */ (input.value) }));
  }
  scene.on(["show"], () => inputs.forEach((input) => (input.checked = input.value === scene.state.show)));
}
