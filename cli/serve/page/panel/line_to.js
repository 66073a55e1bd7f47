// The choice of another mast to which a mast's line of sight goes.

import { make } from "./elements.js";

/** @typedef {import("../state/scene.js").Mast} Mast */
/** @typedef {import("../state/scene.js").Target} Target */

const NO_MAST = "";

export class LineTo {
  box = make("label", "field wide");
  #select = make("select");

  /** @param {(target: Target | null) => void} choose */
  constructor(choose) {
    this.box.append(make("span", "", "Line to"), this.#select);
    this.#select.addEventListener("change", () => {
      const { value } = this.#select;
      choose(value === NO_MAST ? null : { mast: Number(value) });
    });
  }

  /** @param {Mast[]} others @param {Target | null} target */
  offer(others, target) {
    this.box.hidden = others.length === 0;
    const none = new Option(target && !("mast" in target) ? "the place clicked" : "a place: click it", NO_MAST);
    this.#select.replaceChildren(none, ...others.map(({ id, name }) => new Option(name, String(id))));
    this.#select.value = target && "mast" in target ? String(target.mast) : NO_MAST;
  }
}
