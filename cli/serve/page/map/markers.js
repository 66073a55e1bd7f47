// Markers on the map: buttons that are dragged with the pointer or moved with the arrow keys.

import { Overlay } from "../vendor/ol.js";
import { hueCss } from "../seen/palette.js";
import { follow } from "./dragging.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../state/scene.js").SceneState} SceneState */
/** @typedef {import("../state/scene.js").Place} Place */
/** @typedef {import("../vendor/ol.js").OlMap} OlMap */
/** @typedef {Place & {id: number, text: string, label: string, hue: number, selected: boolean, moved?: boolean}} Marked */
/**
 * @typedef {object} MarkerKind
 * @property {string} className
 * @property {(keyof SceneState)[]} keys      What the markers follow.
 * @property {(state: SceneState) => Marked[]} marked
 * @property {(id: number) => void} select
 * @property {(id: number, to: Place) => void} move
 * @property {(id: number) => void} remove    Called for the key Delete.
 */

export class Markers {
  /** @type {Map<number, Overlay>} */
  #markers = new Map();

  /** @param {OlMap} map @param {Scene} scene @param {MarkerKind} kind */
  constructor(map, scene, kind) {
    this.map = map;
    this.scene = scene;
    this.kind = kind;
    scene.on(kind.keys, () => this.#follow());
  }

  /** @param {number} id */
  focus(id) {
    this.#markers.get(id)?.getElement()?.focus({ preventScroll: true });
  }

  #follow() {
    const marked = this.kind.marked(this.scene.state);
    for (const [id, marker] of this.#markers) {
      if (marked.some((some) => some.id === id)) continue;
      this.map.removeOverlay(marker);
      this.#markers.delete(id);
    }
    for (const some of marked) this.#show(some);
  }

  /** @param {Marked} marked */
  #show({ id, text, label, hue, selected, moved, x, y }) {
    const marker = this.#markers.get(id) ?? this.#make(id);
    const button = /** @type {HTMLElement} */ (marker.getElement());
    button.textContent = text;
    button.style.setProperty("--hue", hueCss(hue));
    button.setAttribute("aria-label", `${label}. Arrow keys move it, with Shift ten times as far.`);
    button.setAttribute("aria-pressed", String(selected));
    button.classList.toggle("moved", Boolean(moved));
    marker.setPosition([x, y]);
  }

  /** @param {number} id */
  #make(id) {
    const { className, select, move, remove } = this.kind;
    const button = document.createElement("button");
    button.type = "button";
    button.className = className;
    const find = () => this.kind.marked(this.scene.state).find((some) => some.id === id);
    for (const chosen of ["pointerdown", "focus"]) {
      button.addEventListener(chosen, () => find()?.selected === false && select(id));
    }
    // The wheel zooms over a marker as it does beside it.
    button.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.map.getViewport().dispatchEvent(new WheelEvent(event.type, event));
    });
    follow(this.map, button, {
      place: find,
      cell: () => this.scene.cell,
      move: (to) => move(id, to),
      remove: () => remove(id),
    });
    // Markers have the order of what they stand for, for those who go by the Tab key.
    const marker = new Overlay({ element: button, positioning: "center-center", insertFirst: false });
    this.map.addOverlay(marker);
    this.#markers.set(id, marker);
    return marker;
  }
}
