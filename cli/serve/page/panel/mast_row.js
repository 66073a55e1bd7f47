// A mast in the list: one line with what it sees, and its fields while it is selected.

import { make } from "./elements.js";
import { LineTo } from "./line_to.js";
import { inPageWords } from "./page_words.js";
import { areaText, numberText, shareText } from "./words.js";
import { hueCss } from "../seen/palette.js";
import { letterOf } from "../state/mast_letter.js";
import { nameIn } from "../state/scene.js";
import { onTyped } from "./typed.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../state/scene.js").Mast} Mast */

/** How far away, in cells, the highest ground near by may be. */
export const NEAR_BY = 10;

/** @type {["name" | "x" | "y" | "height", string, string][]} */
const FIELDS = [
  ["name", "Name", ""],
  ["x", "Easting", "m"],
  ["y", "Northing", "m"],
  ["height", "Height", "m"],
];

/** What a field's text says, or null where it says nothing that can be used. @param {string} name @param {string} text */
function valueOf(name, text) {
  if (text.trim() === "") return null;
  if (name === "name") return nameIn(text);
  return Number.isFinite(Number(text)) ? Number(text) : null;
}

export class MastRow {
  item = make("li", "mast");
  #head = make("button", "mast-head");
  #dot = make("span", "dot");
  #name = make("span", "mast-name");
  #summary = make("span", "mast-summary");
  #fields = make("div", "mast-fields");
  #notes = make("p", "quiet");
  #climb = make("p", "quiet");
  /** @type {Record<string, HTMLInputElement>} */
  #inputs = {};

  /** @param {Scene} scene @param {number} id @param {() => void} climb */
  constructor(scene, id, climb) {
    this.lineTo = new LineTo((target) => scene.change({ target }));
    this.#head.type = "button";
    this.#head.append(this.#dot, this.#name, this.#summary);
    this.#head.addEventListener("click", () => scene.change({ selected: id }));
    for (const [name, label, unit] of FIELDS) {
      const box = make("label", `field field-${name}`);
      const input = make("input");
      input.inputMode = name === "name" ? "text" : "decimal";
      input.autocomplete = "off";
      // A place that is half typed would send the mast away.
      const isPlace = name === "x" || name === "y";
      onTyped(input, (_, left) => {
        const value = valueOf(name, input.value);
        if (!left && (isPlace || value === null)) return;
        input.setAttribute("aria-invalid", String(value === null));
        input.setCustomValidity(value !== null ? "" : name === "name" ? "Give it a name." : "Give a number of metres.");
        input.reportValidity();
        if (value !== null) scene.changeMast(id, { [name]: value });
      });
      box.append(make("span", "", label), input, ...(unit ? [make("span", "unit", unit)] : []));
      this.#fields.append(box);
      this.#inputs[name] = input;
    }
    const actions = actionsOf(climb, () => scene.removeMast(id));
    this.#fields.append(this.lineTo.box, actions, this.#climb, this.#notes);
    this.item.append(this.#head, this.#fields);
  }

  /** @param {Scene} scene @param {Mast} mast */
  show({ state: { masts, selected, target } }, mast) {
    const chosen = mast.id === selected;
    this.item.style.setProperty("--hue", hueCss(mast.hue));
    this.item.classList.toggle("selected", chosen);
    this.#head.setAttribute("aria-expanded", String(chosen));
    this.#fields.hidden = !chosen;
    this.#climb.textContent = "";
    this.#dot.textContent = letterOf(mast);
    this.#name.textContent = mast.name;
    for (const [name] of FIELDS) {
      const input = this.#inputs[name];
      // What is being typed stays as it is typed.
      if (valueOf(name, input.value) !== mast[name]) input.value = String(mast[name]);
    }
    this.lineTo.offer(
      masts.filter(({ id }) => id !== mast.id),
      target,
    );
  }

  /** Says how far the way to the top was, metres; null where there is no ground. @param {number | null} moved */
  tellClimb(moved) {
    this.#climb.textContent =
      moved === null
        ? "There is no ground near by."
        : moved === 0
          ? "It stands on the highest ground near by."
          : `Moved ${numberText(moved)} m to the highest ground near by.`;
  }

  /** @param {import("../seen/live_views.js").MastView | undefined} view */
  summarise(view) {
    this.#summary.classList.toggle("problem", Boolean(view?.error));
    // While a new answer comes, the one before stays, unless nothing of it is shown any more.
    const before = view?.cells ? this.#summary.textContent : "";
    this.#summary.textContent = view?.error ? inPageWords(view.error) : view?.done ? summaryOf(view.done) : before;
    this.#notes.textContent = view?.done ? notesOf(view.done) : "";
    this.item.classList.toggle("working", !view?.done && !view?.error);
  }
}

/** @param {import("../server/live_connection.js").Message} done */
export function summaryOf({ cells, area_m2 }) {
  const looked = cells.visible + cells.hidden + cells.undecided + (cells.zone_cut ?? 0);
  const what = cells.zone_cut === undefined ? "sees" : "zone clear";
  return `${what} ${areaText(area_m2.visible)}, ${shareText(cells.visible, looked)}`;
}

/** What else the planner should know of the answer. @param {import("../server/live_connection.js").Message} done */
function notesOf({ area_m2, warnings }) {
  const cut = area_m2.zone_cut ? [`${areaText(area_m2.zone_cut)} more are in sight with the Fresnel zone cut`] : [];
  return [...cut, ...warnings.map((/** @type {string} */ warning) => inPageWords(warning))]
    .map((note) => `${note.slice(0, 1).toUpperCase()}${note.slice(1)}.`)
    .join(" ");
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
