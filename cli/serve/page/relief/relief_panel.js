// The 3-D view over the map: opened by a button, which loads what draws it; it follows what the map shows.

import { element } from "../panel/elements.js";
import { entryElement } from "../panel/legend.js";
import { problemText } from "../panel/page_words.js";
import { metresText } from "../panel/words.js";
import { HUES } from "../seen/palette.js";
import { middleSeen } from "../seen/middle_seen.js";
import { shownOf } from "../seen/shown.js";
import { TIPS, viewerOf, viewersOf } from "../seen/viewers.js";
import { paintDrape } from "./drape.js";
import { extentFor, toleranceFor } from "./window.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../seen/live_views.js").LiveViews} LiveViews */
/** @typedef {import("../server/api.js").Info} Info */
/** @typedef {import("../vendor/ol.js").OlMap} OlMap */
/** @typedef {import("./relief_scene.js").ReliefScene} ReliefScene */
/** @typedef {import("./relief_scene.js").Standing} Standing */
/** @typedef {import("./window.js").Extent} Extent */

// The server makes one window at a time.
const BUSY = 429;
const MOST_TRIES = 20;
const BETWEEN_TRIES = 500;

/** What stands on the ground: masts and sites, or turbines, as soon as their ground is known.
 * @param {Scene} scene @param {LiveViews} views @returns {Standing[]} */
function standingOf({ state }, views) {
  const masts = viewersOf(state).map((mast) => ({
    ...mast,
    colour: `rgb(${HUES[mast.hue % HUES.length].join(",")})`,
    ground: groundOf(views, mast.id),
  }));
  const turbines = state.turbines.map(({ id, x, y, tip }, i) => {
    return { id, x, y, height: tip, colour: "#ffffff", ground: groundOf(views, TIPS, i) };
  });
  return (state.task === "turbines" ? turbines : masts).filter(({ ground }) => Number.isFinite(ground));
}

/** @param {LiveViews} views @param {number} id @param {number} [place] */
const groundOf = (views, id, place = 0) => views.of(id)?.begun?.grounds[place] ?? NaN;

/** @param {Info} info @param {Extent} extent @param {Record<string, string>} options @returns {Promise<ArrayBuffer>} */
async function loadTriangles(info, extent, { themes, tolerance }) {
  const query = new URLSearchParams({ bbox: extent.join(","), ...(themes ? { themes } : {}) });
  query.set("tolerance", tolerance ?? String(toleranceFor(info, extent)));
  for (let tries = 0; ; ++tries) {
    const answer = await fetch(`/tin.glb?${query}`);
    if (answer.ok) return answer.arrayBuffer();
    const problem = (await answer.json().catch(() => null))?.error ?? `the server answered ${answer.status}`;
    if (answer.status !== BUSY || tries === MOST_TRIES) throw new Error(problem);
    await new Promise((resume) => setTimeout(resume, BETWEEN_TRIES));
  }
}

class ReliefPanel {
  #panel = element("relief-view");
  #said = element("relief-said");
  #drape = document.createElement("canvas");
  /** @type {ReliefScene | null} */
  #relief = null;
  /** @type {Extent} */
  #extent = [0, 0, 1, 1];
  #inside = false;

  /** @param {{scene: Scene, views: LiveViews, map: OlMap, info: Info}} world */
  constructor({ scene, views, map, info }) {
    this.scene = scene;
    this.views = views;
    this.map = map;
    this.info = info;
    element("relief-button").addEventListener("click", () => this.#open());
    element("relief-close").addEventListener("click", () => this.#close());
    element("relief-inside").addEventListener("click", () => this.#turn(!this.#inside));
    this.#panel.addEventListener("keydown", (event) => {
      if (event.key !== "Escape") return;
      event.stopPropagation();
      this.#close();
    });
    views.onChange(() => this.#follow());
    scene.on(["selected", "show", "part", "plan"], () => this.#follow());
    scene.on(["task"], () => !this.#panel.hidden && this.#close());
  }

  async #open() {
    this.#panel.hidden = false;
    this.#panel.append(element("legend"));
    this.#said.textContent = "Loading the ground …";
    try {
      const state = this.scene.state;
      const places = state.task === "turbines" ? state.turbines : viewersOf(state);
      const shown = /** @type {Extent} */ (this.map.getView().calculateExtent());
      this.#extent = extentFor(this.info, places, Number(state.options.radius), shown);
      const [bytes, { ReliefScene: Relief }] = await Promise.all([
        loadTriangles(this.info, this.#extent, state.options),
        import("./relief_scene.js"),
      ]);
      if (this.#panel.hidden) return;
      this.#relief = new Relief(element("relief-picture"), this.#drape);
      const colours = await this.#relief.take(bytes, this.#extent);
      element("standing").hidden = colours.size === 0;
      element("standing-list").replaceChildren(...Array.from(colours, ([name, css]) => entryElement([css, name, 1])));
      this.#said.textContent = "";
      this.#follow();
      this.#turn(false);
      element("relief-picture").focus();
    } catch (problem) {
      this.#said.textContent = `The 3-D view cannot be shown: ${problemText(problem)}`;
    }
  }

  #close() {
    this.#relief?.end();
    this.#relief = null;
    this.#panel.hidden = true;
    element("map").append(element("legend"));
    element("relief-button").focus();
  }

  #follow() {
    if (!this.#relief) return;
    paintDrape(this.#drape, this.#extent, shownOf(this.scene, this.views));
    this.#relief.drapeChanged();
    this.#relief.showMasts(standingOf(this.scene, this.views));
    const viewer = viewerOf(this.scene.state);
    const button = /** @type {HTMLButtonElement} */ (element("relief-inside"));
    button.hidden = !viewer;
    if (viewer) button.textContent = this.#inside ? "From outside" : `From ${viewer.name}`;
  }

  /** @param {boolean} inside  Whether to look from the mast selected. */
  #turn(inside) {
    const viewer = viewerOf(this.scene.state);
    const mast = standingOf(this.scene, this.views).find(({ id }) => id === viewer?.id) ?? null;
    this.#inside = inside && mast !== null;
    if (this.#inside && mast) this.#relief?.fromEye(mast, middleSeen(this.views.of(mast.id)?.cells));
    else this.#relief?.fromOutside(mast);
    this.#said.textContent = this.#inside && mast ? `Eyes ${metresText(mast.height)} above the ground` : "";
    this.#follow();
  }
}

/** @param {{scene: Scene, views: LiveViews, map: OlMap, info: Info}} world */
export const makeReliefPanel = (world) => new ReliefPanel(world);
