// What is under the cursor: asked of the server for the mast selected, looked up in the cells for the others.

import { element, make } from "./elements.js";
import { azimuthsText, distanceText, metresText, numberText, placeText } from "./words.js";
import { CUT, NEAREST, VERDICT, VISIBLE } from "../seen/seen_cells.js";
import { hueCss } from "../seen/palette.js";
import { letterOf } from "../state/mast_letter.js";
import { valueModeOf, withUnit } from "../seen/values.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../seen/live_views.js").LiveViews} LiveViews */
/** @typedef {import("../server/live_connection.js").Message} Message */

const BESIDE = 18; // pixels between the pointer and the readout
const NEVER_SENT = -1;

export class Readout {
  #box = element("readout");
  #verdict = make("p", "readout-verdict");
  #masts = make("p", "readout-masts");
  #facts = make("dl");
  /** @type {number[] | null} */
  #place = null;
  #pixel = [0, 0];
  #seq = 0;
  #waiting = false;

  /** @param {Scene} scene @param {LiveViews} views @param {import("../vendor/ol.js").OlMap} map
   * @param {import("../server/live_connection.js").LiveConnection} connection */
  constructor(scene, views, map, connection) {
    this.scene = scene;
    this.views = views;
    this.connection = connection;
    this.#box.append(this.#verdict, this.#masts, this.#facts);
    map.on("pointermove", ({ coordinate, pixel, dragging }) => this.#moved(dragging ? null : coordinate, pixel));
    // Markers are above the viewport: to enter one leaves the map.
    map.getViewport().addEventListener("pointerleave", () => this.#moved(null, [0, 0]));
    map.getOverlayContainerStopEvent().addEventListener("pointerover", () => this.#moved(null, [0, 0]));
    connection.on("probe", (message) => message.seq === this.#seq && this.#show(message));
    views.onChange(() => this.#ask());
    scene.on(["selected"], () => this.#ask());
  }

  /** @param {number[] | null} place @param {number[]} pixel */
  #moved(place, pixel) {
    this.#place = this.scene.mast && !this.scene.state.placing ? place : null;
    this.#pixel = pixel;
    if (!this.#place) this.#box.hidden = true;
    this.#putBeside();
    this.#ask();
  }

  /** Puts the box beside the pointer, on that side where the map has room for it. */
  #putBeside() {
    const { offsetWidth, offsetHeight } = this.#box;
    const { clientWidth, clientHeight } = /** @type {HTMLElement} */ (this.#box.parentElement);
    const [x, y] = this.#pixel;
    const left = x + BESIDE + offsetWidth > clientWidth ? x - BESIDE - offsetWidth : x + BESIDE;
    const top = y + BESIDE + offsetHeight > clientHeight ? y - BESIDE - offsetHeight : y + BESIDE;
    this.#box.style.translate = `${left}px ${Math.max(0, top)}px`;
  }

  /** Asks once for each picture at most. */
  #ask() {
    if (this.#waiting) return;
    this.#waiting = true;
    requestAnimationFrame(() => {
      this.#waiting = false;
      const mast = this.scene.mast;
      if (!mast || !this.#place) return;
      this.#seq += 1;
      this.connection.send({ type: "probe", id: mast.id, seq: this.#seq, x: this.#place[0], y: this.#place[1] });
    });
  }

  /** @param {Message} probe */
  #show(probe) {
    const mast = this.scene.mast;
    const place = this.#place;
    if (!mast || !place) return;
    this.#box.hidden = false;
    this.#verdict.textContent = `${mast.name}: ${verdictOf(probe)}`;
    this.#verdict.style.setProperty("--hue", hueCss(mast.hue));
    this.#facts.replaceChildren(
      ...factsOf(probe, place, this.#valueAt(place)).flatMap(([name, value]) => [
        make("dt", "", name),
        make("dd", "", value),
      ]),
    );
    this.#masts.replaceChildren(
      ...this.scene.state.masts.filter((other) => other.id !== mast.id).map((other) => this.#chip(other, place)),
    );
    this.#masts.hidden = this.scene.state.masts.length < 2;
    this.#putBeside();
  }

  /** Whether another mast sees the cell. @param {import("../state/scene.js").Mast} mast @param {number[]} place */
  #chip(mast, place) {
    const cells = this.views.of(mast.id)?.cells;
    const at = cells ? cells.at(place[0], place[1]) : NEVER_SENT;
    const verdict = at < 0 ? NEVER_SENT : (cells?.codes[at] ?? 0) & VERDICT;
    const sees = verdict === VISIBLE || verdict === CUT;
    const chip = make("span", sees ? "chip sees" : "chip", `${letterOf(mast)} ${sees ? "sees it" : "does not"}`);
    chip.style.setProperty("--hue", hueCss(mast.hue));
    return chip;
  }

  /** The value of the cell, in modes with values. @param {number[]} place @returns {[string, string][]} */
  #valueAt([x, y]) {
    const mode = valueModeOf(this.scene.state.options);
    const cells = this.views.of(this.scene.mast?.id ?? NEVER_SENT)?.cells;
    const at = cells?.at(x, y) ?? NEVER_SENT;
    const value = at < 0 || (cells?.codes[at] ?? 0) & NEAREST ? NaN : (cells?.values?.[at] ?? NaN);
    return mode && !Number.isNaN(value) ? [[mode.short, withUnit(numberText(value, 2), mode.unit)]] : [];
  }
}

/** @param {Message} probe */
function verdictOf({ verdict, lacks_m }) {
  if (verdict === "visible") return "visible";
  if (verdict === "undecided") return "undecided";
  return lacks_m > 0 ? `hidden, ${metresText(lacks_m)} short` : "hidden";
}

/** @param {Message} probe @param {number[]} place @param {[string, string][]} value @returns {[string, string][]} */
function factsOf(probe, [x, y], value) {
  /** @type {[string, string][]} */
  const facts = [
    ["Distance", distanceText(probe.distance_m)],
    ["Azimuth", azimuthsText(probe.azimuth_deg, probe.azimuth_true_deg)],
    ["Back", azimuthsText(probe.back_azimuth_deg, probe.back_azimuth_true_deg)],
  ];
  if (probe.ground_m !== null) facts.push(["Ground", metresText(probe.ground_m)]);
  if (probe.surface_m !== null && probe.surface_m !== probe.ground_m) {
    facts.push(["Surface", metresText(probe.surface_m)]);
  }
  if (probe.blocker) facts.push(["Hidden by", blockerText(probe.blocker)]);
  return [...facts, ...value, ["At", placeText(x, y)]];
}

/** @param {{what: string, distance_m: number}} blocker */
const blockerText = ({ what, distance_m }) =>
  `${what === "terrain" ? "the ground" : what}, ${distanceText(distance_m)} from the mast`;
