// What is under the cursor: asked of the server for the mast selected, looked up in the cells for the others. Before
// anything stands on the map, and while something is placed, where the cursor is and how high the ground.

import { element, make } from "./elements.js";
import { azimuthsText, degreesText, distanceText, metresText, numberText, placeText } from "./words.js";
import { CUT, NEAREST, VERDICT, VISIBLE } from "../seen/seen_cells.js";
import { hueCss } from "../seen/palette.js";
import { askPlace } from "../server/api.js";
import { nearestPlace } from "../state/nearest.js";
import { SERVICES } from "../state/premises.js";
import { letterOf } from "../state/mast_letter.js";
import { withUnit } from "../seen/values.js";
import { HUBS, TIPS, modeOf, viewerOf, viewersOf } from "../seen/viewers.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../seen/live_views.js").LiveViews} LiveViews */
/** @typedef {import("../server/live_connection.js").Message} Message */

const NEAR_PIXELS = 8; // between the cursor and a dot that it means
const BESIDE = 18; // pixels between the pointer and the readout
const NEVER_SENT = -1;
const LONG = 20; // letters: where a CRS has no code, its whole text stands in its place

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
  #asking = false;

  /** @param {Scene} scene @param {LiveViews} views @param {import("../vendor/ol.js").OlMap} map
   * @param {import("../server/live_connection.js").LiveConnection} connection
   * @param {import("../server/api.js").Info} info */
  constructor(scene, views, map, connection, info) {
    this.info = info;
    this.scene = scene;
    this.views = views;
    this.connection = connection;
    this.map = map;
    this.#box.append(this.#verdict, this.#masts, this.#facts);
    map.on("pointermove", ({ coordinate, pixel, dragging }) => this.#moved(dragging ? null : coordinate, pixel));
    // Markers are above the viewport: to enter one leaves the map.
    map.getViewport().addEventListener("pointerleave", () => this.#moved(null, [0, 0]));
    map.getOverlayContainerStopEvent().addEventListener("pointerover", () => this.#moved(null, [0, 0]));
    connection.on("probe", (message) => message.seq === this.#seq && this.#show(message));
    views.onChange(() => this.#ask());
    scene.on(["selected", "task", "plan"], () => this.#ask());
  }

  /** @param {number[] | null} place @param {number[]} pixel */
  #moved(place, pixel) {
    this.#place = place && (this.#isSeen || this.#isOnData(place)) ? place : null;
    this.#pixel = pixel;
    if (!this.#place) this.#box.hidden = true;
    this.#putBeside();
    this.#ask();
  }

  /** Whether the map shows what is seen, and not where something is to stand. */
  get #isSeen() {
    const { state } = this.scene;
    if (state.placing) return false;
    return state.task === "turbines" ? state.turbines.length > 0 : viewerOf(state) !== null;
  }

  /** @param {number[]} place */
  #isOnData([x, y]) {
    const { xmin, ymin, xmax, ymax } = this.info.bounds;
    return x >= xmin && x <= xmax && y >= ymin && y <= ymax;
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
      const mast = viewerOf(this.scene.state);
      if (!this.#place) return;
      if (!this.#isSeen) return void this.#askGround();
      if (!mast) return this.#showCounts(this.#place);
      this.#seq += 1;
      this.connection.send({ type: "probe", id: mast.id, seq: this.#seq, x: this.#place[0], y: this.#place[1] });
    });
  }

  /** Asks what the ground is under the cursor, one place at a time. */
  async #askGround() {
    if (this.#asking) return;
    const asked = this.#place;
    if (!asked) return;
    this.#asking = true;
    try {
      const known = await askPlace(asked.join(","));
      if (this.#place && !this.#isSeen) this.#showGround(known);
    } catch {
      // The map's own tiles of the ground say what is wrong with the server or the store.
    }
    this.#asking = false;
    if (this.#place && this.#place !== asked) this.#ask();
  }

  /** @param {import("../server/api.js").KnownPlace} known */
  #showGround({ x, y, lon, lat, grid_reference, ground_m }) {
    /** @type {[string, string][]} */
    const facts = [["At", placeText(x, y)]];
    if (grid_reference) facts.push(["Grid reference", grid_reference]);
    if (lon !== null && lat !== null) facts.push(["Degrees", degreesText(lon, lat)]);
    facts.push(["In", this.info.crs.length > LONG ? this.info.crs_name : this.info.crs]);
    this.#masts.hidden = true;
    this.#tell(ground_m === null ? "Ground without data" : `Ground ${metresText(ground_m)}`, null, facts);
  }

  /** @param {Message} probe */
  #show(probe) {
    const mast = viewerOf(this.scene.state);
    const place = this.#place;
    if (!mast || !place || !this.#isSeen) return;
    const others = viewersOf(this.scene.state).filter((other) => other.id !== mast.id);
    this.#masts.replaceChildren(...others.map((other) => this.#chip(other, place)));
    this.#masts.hidden = others.length === 0;
    const facts = factsOf(probe, place, this.#valueAt(place));
    this.#tell(`${mast.name}: ${verdictOf(probe)}`, mast.hue, [...this.#buildingAt(place), ...facts]);
  }

  /** How the building of a dot under the cursor was served. @param {number[]} place @returns {[string, string][]} */
  #buildingAt(place) {
    const { task, premises } = this.scene.state;
    const within = NEAR_PIXELS * (this.map.getView().getResolution() ?? 1);
    const building = task === "premises" && premises ? nearestPlace(premises, place, within) : null;
    if (!building) return [];
    const text = SERVICES.find(({ service }) => service === building.service)?.text ?? building.service;
    return [[building.name, [text, building.how].filter(Boolean).join(", ")]];
  }

  /** How many turbines are seen. @param {number[]} place */
  #showCounts(place) {
    if (this.scene.state.task !== "turbines") return;
    const all = this.scene.state.turbines;
    const hubs = all.filter(({ hub }) => hub !== null);
    const count = (/** @type {number} */ id, /** @type {number} */ most) =>
      `${this.#cellValue(id, place) || 0} of ${most}`;
    /** @type {[string, string][]} */
    const facts = [["Blade tips", count(TIPS, all.length)]];
    if (hubs.length > 0) facts.push(["Hubs", count(HUBS, hubs.length)]);
    const nearest = Math.min(...all.map(({ x, y }) => Math.hypot(x - place[0], y - place[1])));
    facts.push(["Nearest turbine", distanceText(nearest)], ["At", placeText(place[0], place[1])]);
    this.#masts.hidden = true;
    this.#tell(this.#cellValue(TIPS, place) > 0 ? "Turbines are seen" : "No turbine is seen", 0, facts);
  }

  /** @param {string} verdict @param {number | null} hue  Null where it is of no mast.
   * @param {[string, string][]} facts */
  #tell(verdict, hue, facts) {
    this.#box.hidden = false;
    this.#verdict.textContent = verdict;
    this.#verdict.style.setProperty("--hue", hue === null ? "transparent" : hueCss(hue));
    this.#facts.replaceChildren(...facts.flatMap(([name, value]) => [make("dt", "", name), make("dd", "", value)]));
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
  #valueAt(place) {
    const mode = modeOf(this.scene.state);
    const value = this.#cellValue(viewerOf(this.scene.state)?.id ?? NEVER_SENT, place);
    return mode && !Number.isNaN(value) ? [[mode.short, withUnit(numberText(value, 2), mode.unit)]] : [];
  }

  /** @param {number} id @param {number[]} place */
  #cellValue(id, [x, y]) {
    const cells = this.views.of(id)?.cells;
    const at = cells?.at(x, y) ?? NEVER_SENT;
    return at < 0 || (cells?.codes[at] ?? 0) & NEAREST ? NaN : (cells?.values?.[at] ?? NaN);
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
