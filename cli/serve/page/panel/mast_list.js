// The list of masts, and what it does with them.

import { element } from "./elements.js";
import { MastRow, NEAR_BY } from "./mast_row.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../seen/live_views.js").LiveViews} LiveViews */
/** @typedef {import("../map/height_tiles.js").HeightTiles} HeightTiles */

export class MastList {
  #list = element("masts");
  /** @type {Map<number, MastRow>} */
  #rows = new Map();

  /** @param {Scene} scene @param {LiveViews} views @param {HeightTiles} tiles */
  constructor(scene, views, tiles) {
    this.scene = scene;
    this.views = views;
    this.tiles = tiles;
    scene.on(["masts", "selected", "target"], () => this.#follow());
    views.onChange(() => this.#rows.forEach((row, id) => row.summarise(views.of(id))));
  }

  #follow() {
    const { masts } = this.scene.state;
    element("show").hidden = masts.length < 2;
    element("no-masts").hidden = masts.length > 0;
    for (const [id, row] of this.#rows) {
      if (masts.some((mast) => mast.id === id)) continue;
      row.item.remove();
      this.#rows.delete(id);
    }
    for (const mast of masts) {
      const row = this.#rows.get(mast.id) ?? this.#add(mast.id);
      row.show(this.scene, mast);
    }
  }

  /** @param {number} id */
  #add(id) {
    const row = new MastRow(this.scene, id, () => this.#climb(id));
    this.#list.append(row.item);
    this.#rows.set(id, row);
    return row;
  }

  /** Moves the mast up to the highest ground near by. @param {number} id */
  async #climb(id) {
    const mast = this.scene.state.masts.find((some) => some.id === id);
    const cell = Number(this.scene.state.options.cell) || 10;
    const top = mast && (await this.tiles.highest(mast.x, mast.y, NEAR_BY * cell));
    const moved = mast && top ? Math.hypot(top.x - mast.x, top.y - mast.y) : 0;
    if (top && moved > 0) this.scene.changeMast(id, top);
    this.#rows.get(id)?.tellClimb(top ? moved : null);
  }
}
