// The views at the server, one for each mast, or of all turbines: asks for them, follows what changes, and keeps what
// comes.

import { SeenCells } from "./seen_cells.js";
import { wantedOf } from "./viewers.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("./viewers.js").Wanted} Wanted */
/** @typedef {import("../server/live_connection.js").LiveConnection} LiveConnection */
/** @typedef {import("../server/live_connection.js").Message} Message */
/**
 * @typedef {object} MastView
 * @property {string} options          The options that the server was sent last, but for the observer.
 * @property {string} observer         The observers that it was sent last, as JSON.
 * @property {number} seq              What it was last asked for.
 * @property {SeenCells | null} begun  The cells that tiles are about to fill.
 * @property {SeenCells | null} cells  The cells that are shown.
 * @property {Message | null} done     The server's summary, once all cells are decided.
 * @property {string} error            What the server found wrong, or empty.
 * @property {string} field            The option that is at fault, with its dashes, where one is.
 */

const MOST_CELLS = 25e6;
// What else errors are about, under ids of its own.
const OF_OTHERS = ["probe", "line"];

/** Says that a view has more cells than a browser holds, or nothing. @param {Record<string, string>} options */
function tooManyCells({ radius, cell }) {
  const cells = (2 * Number(radius)) ** 2 / Number(cell) ** 2;
  if (!(cells > MOST_CELLS)) return "";
  const least = Math.ceil((20 * Number(radius)) / Math.sqrt(MOST_CELLS)) / 10;
  return `the map shows ${MOST_CELLS / 1e6} million cells at most: take a cell of ${least} m or more, or a smaller radius`;
}

export class LiveViews {
  /** @type {Map<number, MastView>} */
  #views = new Map();
  /** @type {(() => void)[]} */
  #listeners = [];
  #told = false;
  #seq = 0;

  /** @param {Scene} scene @param {LiveConnection} connection */
  constructor(scene, connection) {
    this.scene = scene;
    this.connection = connection;
    connection.onTile = (tile) => this.#takeTile(tile);
    connection.on("begun", (message) =>
      this.#answered(message, (view) => (view.begun = new SeenCells(/** @type {any} */ (message)))),
    );
    connection.on("done", (message) => this.#answered(message, (view) => (view.done = message)));
    connection.on("error", (message) =>
      this.#answered(message, (view) => Object.assign(view, { error: message.error, field: message.field ?? "" })),
    );
    connection.on("welcome", () => this.#askAnew());
    scene.on(["masts", "options", "task", "turbines", "plan"], () => this.#follow());
  }

  /** Calls `listener` before the next picture after each change. @param {() => void} listener */
  onChange(listener) {
    this.#listeners.push(listener);
  }

  /** @param {number} id @returns {MastView | undefined} */
  of(id) {
    return this.#views.get(id);
  }

  get all() {
    return [...this.#views.values()];
  }

  /** Whether all that was asked for has come. */
  get settled() {
    return this.all.every((view) => view.done !== null || view.error !== "");
  }

  #askAnew() {
    this.#views.clear();
    this.#follow();
  }

  #follow() {
    const wanted = wantedOf(this.scene.state);
    for (const id of [...this.#views.keys()]) {
      if (!wanted.some((some) => some.id === id)) this.#stop(id);
    }
    for (const view of wanted) this.#ask(view);
    this.#tell();
  }

  /** @param {number} id */
  #stop(id) {
    this.connection.send({ type: "stop", id });
    this.#views.delete(id);
  }

  /** Sends what the server does not know yet of a view. @param {Wanted} wanted */
  #ask({ id, options: wantedOptions, observer: place }) {
    const options = JSON.stringify(wantedOptions);
    const observer = JSON.stringify(place);
    const known = this.#views.get(id);
    if (known?.options === options && known.observer === observer) return;
    const seq = ++this.#seq;
    const tooMany = tooManyCells(wantedOptions);
    if (tooMany) this.connection.send({ type: "stop", id });
    else if (known?.options === options) this.connection.send({ type: "move", id, seq, observer: place });
    else this.connection.send({ type: "view", id, seq, options: { ...wantedOptions, observer: place } });
    this.#views.set(id, {
      options,
      observer,
      seq,
      begun: known?.begun ?? null,
      cells: tooMany ? null : (known?.cells ?? null),
      done: null,
      error: tooMany,
      field: tooMany ? "--cell" : "",
    });
  }

  /**
   * Takes an answer to what the mast was asked last; a view that began before still shows, as the newest there is.
   * @param {Message} message
   * @param {(view: MastView) => void} take
   */
  #answered(message, take) {
    const view = this.#views.get(message.id ?? -1);
    const newest = message.seq === view?.seq || message.type === "begun";
    if (!view || !newest || OF_OTHERS.includes(message.of)) return;
    take(view);
    if (view.error) view.cells = null;
    this.#tell();
  }

  /** @param {import("../server/tile_message.js").Tile} tile */
  #takeTile(tile) {
    const view = this.#views.get(tile.id);
    if (view?.begun?.seq !== tile.seq) return;
    view.cells = view.begun;
    view.cells.take(tile);
    this.#tell();
  }

  #tell() {
    if (this.#told) return;
    this.#told = true;
    requestAnimationFrame(() => {
      this.#told = false;
      for (const listener of this.#listeners) listener();
    });
  }
}
