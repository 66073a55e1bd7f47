// A marker on the map for each mast: a button that is dragged with the pointer or moved with the arrow keys.

import { Overlay } from "../vendor/ol.js";
import { hueCss } from "../seen/palette.js";
import { metresText } from "../panel/words.js";
import { letterOf } from "../state/mast_letter.js";
import { follow } from "./dragging.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../state/scene.js").Mast} Mast */
/** @typedef {import("../vendor/ol.js").OlMap} OlMap */

export class MastMarkers {
  /** @type {Map<number, Overlay>} */
  #markers = new Map();

  /** @param {OlMap} map @param {Scene} scene */
  constructor(map, scene) {
    this.map = map;
    this.scene = scene;
    scene.on(["masts", "selected"], () => this.#follow());
  }

  /** @param {number} id */
  focus(id) {
    this.#markers.get(id)?.getElement()?.focus({ preventScroll: true });
  }

  #follow() {
    const { masts } = this.scene.state;
    for (const [id, marker] of this.#markers) {
      if (masts.some((mast) => mast.id === id)) continue;
      this.map.removeOverlay(marker);
      this.#markers.delete(id);
    }
    for (const mast of masts) this.#show(mast);
  }

  /** @param {Mast} mast */
  #show(mast) {
    const marker = this.#markers.get(mast.id) ?? this.#make(mast.id);
    const button = /** @type {HTMLElement} */ (marker.getElement());
    button.textContent = letterOf(mast);
    button.style.setProperty("--hue", hueCss(mast.hue));
    button.setAttribute(
      "aria-label",
      `${mast.name}, ${metresText(mast.height)} high. Arrow keys move it, with Shift ten times as far.`,
    );
    button.setAttribute("aria-pressed", String(mast.id === this.scene.state.selected));
    marker.setPosition([mast.x, mast.y]);
  }

  /** @param {number} id */
  #make(id) {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "marker";
    for (const chosen of ["pointerdown", "focus"]) {
      button.addEventListener(chosen, () => this.scene.state.selected !== id && this.scene.change({ selected: id }));
    }
    follow(this.map, button, {
      place: () => this.scene.state.masts.find((mast) => mast.id === id),
      cell: () => Number(this.scene.state.options.cell) || 1,
      move: (to) => this.scene.changeMast(id, to),
      remove: () => this.scene.removeMast(id),
    });
    const marker = new Overlay({ element: button, positioning: "center-center", stopEvent: true });
    this.map.addOverlay(marker);
    this.#markers.set(id, marker);
    return marker;
  }
}
