// What the planner has set up: masts, what is asked of them, and how the map shows it. Everything else follows from it.

/** @typedef {{x: number, y: number}} Place  Metres in the store's CRS. */
/** @typedef {Place & {id: number, name: string, hue: number, height: number}} Mast
 *    `id` tells masts and their views apart, 0 to 7; `hue` is a place in the palette; `height` is above the ground. */
/** @typedef {Place | {mast: number}} Target  A place with a target on it, or another mast by its id. */
/** @typedef {"together" | "alone" | "difference"} Show */
/** @typedef {"masts" | "turbines" | "sites" | "premises"} Task */
/** @typedef {{relief: "shade" | "slope" | "none", contours: boolean, themes: string[]}} Layers */
/**
 * @typedef {object} SceneState
 * @property {Task} task
 * @property {Mast[]} masts
 * @property {number | null} selected  The id of a mast.
 * @property {Show} show
 * @property {Target | null} target    The far end of the line of sight from the selected mast.
 * @property {Record<string, string>} options  Options of `itin viewshed` by their names, as the command line takes
 *   them.
 * @property {Layers} layers
 * @property {{x: number, y: number, resolution: number} | null} view  The middle of the map, and metres a pixel.
 * @property {boolean} placing         Whether the next click on the map places a mast or a turbine, or a corner of an area.
 * @property {import("./turbines.js").Turbine[]} turbines
 * @property {number | null} turbine   The id of the turbine that is selected.
 * @property {"tips" | "hubs"} part    What of the turbines is counted.
 * @property {Place | null} viewpoint  Where a wireline is seen from.
 * @property {import("./plan.js").Search | null} search  Where sites are looked for.
 * @property {import("./served.js").Served} served       What sites are to serve.
 * @property {import("./plan.js").Siting} siting        What is asked of sites.
 * @property {"search" | "served"} drawing  Of which of these two an area is drawn.
 * @property {import("./plan.js").Plan | null} plan      The sites that were chosen.
 * @property {import("./premises.js").Building[] | null} premises  The buildings that were surveyed last.
 */

export const MOST_MASTS = 8;

export class Scene {
  /** @type {{keys: (keyof SceneState)[], listener: () => void}[]} */
  #listeners = [];

  /** @param {SceneState} state */
  constructor(state) {
    this.state = state;
  }

  /** Calls `listener` after each change of one of these parts of the state, and once now.
   * @param {(keyof SceneState)[]} keys @param {() => void} listener */
  on(keys, listener) {
    this.#listeners.push({ keys, listener });
    listener();
  }

  /** @param {Partial<SceneState>} parts */
  change(parts) {
    this.state = { ...this.state, ...parts };
    for (const { keys, listener } of this.#listeners) {
      if (keys.some((key) => key in parts)) listener();
    }
  }

  /** @returns {Mast | null} */
  get mast() {
    return this.state.masts.find((mast) => mast.id === this.state.selected) ?? null;
  }

  /** The side of a cell, metres. */
  get cell() {
    return Number(this.state.options.cell) || 1;
  }

  /** The far end of the line of sight: where it is, how high, and its name if it is a mast.
   * @returns {Place & {height: number | string, name: string} | null} */
  get farEnd() {
    const { target, masts, selected, options, task } = this.state;
    if (!target || !this.mast || task === "turbines" || task === "sites") return null;
    if (!("mast" in target)) return { ...target, height: options["target-height"] ?? 0, name: "" };
    return masts.find(({ id }) => id === target.mast && id !== selected) ?? null;
  }

  /** What the next mast is called that is given no name. */
  get nextName() {
    return `Mast ${String.fromCharCode(65 + firstFree(this.state.masts.map(({ id }) => id)))}`;
  }

  /** Adds a mast, and selects it. It is as high as the one selected, unless its height is given.
   * @param {Place & {name?: string, height?: number}} place */
  addMast(place) {
    const { masts } = this.state;
    if (masts.length >= MOST_MASTS) return;
    const id = firstFree(masts.map((mast) => mast.id));
    const hue = firstFree(masts.map((mast) => mast.hue));
    const mast = { id, hue, name: this.nextName, height: this.mast?.height ?? 20, ...place };
    this.change({ masts: [...masts, mast], selected: id, placing: false });
  }

  /** @param {number} id @param {Partial<Mast>} parts */
  changeMast(id, parts) {
    this.change({ masts: this.state.masts.map((mast) => (mast.id === id ? { ...mast, ...parts } : mast)) });
  }

  /** @param {number} id */
  removeMast(id) {
    const masts = this.state.masts.filter((mast) => mast.id !== id);
    const selected = this.state.selected === id ? (masts[0]?.id ?? null) : this.state.selected;
    const { target } = this.state;
    const lost = masts.length === 0 || (target !== null && "mast" in target && target.mast === id);
    this.change({ masts, selected, ...(lost ? { target: null } : {}) });
  }

  /** An empty value leaves the command line's default. @param {string} name @param {string} value */
  setOption(name, value) {
    const options = { ...this.state.options };
    if (value === "") delete options[name];
    else options[name] = value;
    this.change({ options });
  }
}

/** The name that a text gives, or nothing. The address has names behind commas. @param {string} text */
export const nameIn = (text) => text.trim().replaceAll(",", " ");

/** @param {number[]} taken */
function firstFree(taken) {
  return Array.from({ length: MOST_MASTS }, (_, i) => i).find((i) => !taken.includes(i)) ?? 0;
}
