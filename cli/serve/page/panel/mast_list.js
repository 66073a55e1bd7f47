// The list of masts: one line for each, and the fields of the one selected.

import { element, make } from "./elements.js";
import { areaText, shareText } from "./words.js";
import { hueCss } from "../seen/palette.js";
import { letterOf } from "../state/mast_letter.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../state/scene.js").Mast} Mast */
/** @typedef {import("../seen/live_views.js").LiveViews} LiveViews */
/** @typedef {import("../map/height_tiles.js").HeightTiles} HeightTiles */

const NEAR_BY = 10; // cells: how far the highest ground near by may be

export class MastList {
  #list = element("masts");
  /** @type {Map<number, MastRow>} */
  #rows = new Map();

  /** @param {Scene} scene @param {LiveViews} views @param {HeightTiles} tiles */
  constructor(scene, views, tiles) {
    this.scene = scene;
    this.views = views;
    this.tiles = tiles;
    scene.on(["masts", "selected"], () => this.#follow());
    views.onChange(() => this.#rows.forEach((row, id) => row.summarise(views.of(id))));
  }

  #follow() {
    const { masts, selected } = this.scene.state;
    element("show").hidden = masts.length < 2;
    element("no-masts").hidden = masts.length > 0;
    for (const [id, row] of this.#rows) {
      if (masts.some((mast) => mast.id === id)) continue;
      row.item.remove();
      this.#rows.delete(id);
    }
    for (const mast of masts) {
      const row = this.#rows.get(mast.id) ?? this.#add(mast.id);
      row.show(mast, mast.id === selected);
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
    if (top) this.scene.changeMast(id, top);
  }
}

class MastRow {
  item = make("li", "mast");
  #head = make("button", "mast-head");
  #dot = make("span", "dot");
  #name = make("span", "mast-name");
  #summary = make("span", "mast-summary");
  #fields = make("div", "mast-fields");
  #notes = make("p", "quiet");
  /** @type {Record<string, HTMLInputElement>} */
  #inputs = {};

  /** @param {Scene} scene @param {number} id @param {() => void} climb */
  constructor(scene, id, climb) {
    this.#head.type = "button";
    this.#head.append(this.#dot, this.#name, this.#summary);
    this.#head.addEventListener("click", () => scene.change({ selected: id }));
    this.#field(
      "name",
      "Name",
      "",
      (value) => value.trim() !== "" && scene.changeMast(id, { name: value.replaceAll(",", " ") }),
    );
    for (const [name, label] of [
      ["x", "Easting"],
      ["y", "Northing"],
      ["height", "Height"],
    ]) {
      this.#field(
        name,
        label,
        "m",
        (value) =>
          Number.isFinite(Number(value)) && value.trim() !== "" && scene.changeMast(id, { [name]: Number(value) }),
      );
    }
    this.#fields.append(
      actionsOf(climb, () => scene.removeMast(id)),
      this.#notes,
    );
    this.item.append(this.#head, this.#fields);
  }

  /** @param {string} name @param {string} label @param {string} unit @param {(value: string) => void} change */
  #field(name, label, unit, change) {
    const box = make("label", `field field-${name}`);
    const input = make("input");
    input.inputMode = name === "name" ? "text" : "decimal";
    input.autocomplete = "off";
    input.addEventListener("change", () => change(input.value));
    box.append(make("span", "", label), input, ...(unit ? [make("span", "unit", unit)] : []));
    this.#fields.append(box);
    this.#inputs[name] = input;
  }

  /** @param {Mast} mast @param {boolean} selected */
  show(mast, selected) {
    this.item.style.setProperty("--hue", hueCss(mast.hue));
    this.item.classList.toggle("selected", selected);
    this.#head.setAttribute("aria-expanded", String(selected));
    this.#fields.hidden = !selected;
    this.#dot.textContent = letterOf(mast);
    this.#name.textContent = mast.name;
    for (const name of /** @type {const} */ (["name", "x", "y", "height"])) {
      this.#inputs[name].value = String(mast[name]);
    }
  }

  /** @param {import("../seen/live_views.js").MastView | undefined} view */
  summarise(view) {
    this.#summary.classList.toggle("problem", Boolean(view?.error));
    this.#summary.textContent = view?.error || (view?.done ? summaryOf(view.done) : this.#summary.textContent);
    this.#notes.textContent = view?.done ? notesOf(view.done) : "";
    this.item.classList.toggle("working", !view?.done && !view?.error);
  }
}

/** @param {import("../server/live_connection.js").Message} done */
function summaryOf({ cells, area_m2 }) {
  const looked = cells.visible + cells.hidden + cells.undecided + (cells.zone_cut ?? 0);
  const what = cells.zone_cut === undefined ? "sees" : "zone clear";
  return `${what} ${areaText(area_m2.visible)}, ${shareText(cells.visible, looked)}`;
}

/** What else the planner should know of the answer. @param {import("../server/live_connection.js").Message} done */
function notesOf({ area_m2, warnings }) {
  const cut = area_m2.zone_cut ? [`${areaText(area_m2.zone_cut)} more are in sight with the Fresnel zone cut`] : [];
  return [...cut, ...warnings].map((note) => `${note}.`).join(" ");
}

/** @param {() => void} climb @param {() => void} remove */
function actionsOf(climb, remove) {
  const actions = make("div", "actions");
  const up = make("button", "", "To the top near by");
  const away = make("button", "", "Remove");
  up.type = away.type = "button";
  up.title = `Moves the mast to the highest ground within ${NEAR_BY} cells`;
  up.addEventListener("click", climb);
  away.addEventListener("click", remove);
  actions.append(up, away);
  return actions;
}
