// The views at the server, one for each mast, or of all turbines: asks for them, follows what changes, and keeps what
// comes.

import { SeenCells } from "./seen_cells.js";
import { wantedOf } from "./viewers.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("./viewers.js").Wanted} Wanted */
/** @typedef {import("./cell_window.js").CellWindow} CellWindow */
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
 * @property {boolean} late           Whether a move of it has not been sent yet.
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
  const half = Math.sqrt(MOST_CELLS) / 2;
  const [most, least] = [Math.floor(half * Number(cell)), Math.ceil((10 * Number(radius)) / half) / 10];
  return `the map shows ${MOST_CELLS / 1e6} million cells at most: take a radius of ${most} m or less, or a cell of ${least} m or more`;
}

/** Whether anything of what was asked for last has come. @param {MastView} view */
const hasColours = ({ seq, cells, done, error }) => cells?.seq === seq || done !== null || error !== "";

export class LiveViews {
  /** @type {Map<number, MastView>} */
  #views = new Map();
  /** @type {((come: CellWindow[] | null) => void)[]} */
  #listeners = [];
  #told = false;
  /** Windows of cells that have come since the last picture; null where more has changed.
   * @type {CellWindow[] | null} */
  #come = null;
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

  /** Calls `listener` before the next picture after each change, with the windows of cells that have come where nothing
   * else has changed. @param {(come: CellWindow[] | null) => void} listener */
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
    return this.all.every(({ late, done, error }) => !late && (done !== null || error !== ""));
  }

  #askAnew() {
    this.#views.clear();
    this.#come = null;
    this.#follow();
  }

  #follow() {
    const wanted = wantedOf(this.scene.state);
    for (const id of [...this.#views.keys()]) {
      if (!wanted.some((some) => some.id === id)) this.#stop(id);
    }
    for (const view of wanted) this.#ask(view);
    this.#tellSoon();
  }

  /** @param {number} id */
  #stop(id) {
    this.connection.send({ type: "stop", id });
    this.#views.delete(id);
    this.#come = null;
  }

  /** Sends what the server does not know yet of a view. @param {Wanted} wanted */
  #ask({ id, options: wantedOptions, observer: place }) {
    const options = JSON.stringify(wantedOptions);
    const observer = JSON.stringify(place);
    const known = this.#views.get(id);
    if (known) known.late = false;
    if (known?.options === options && known.observer === observer) return;
    // A move waits for a picture of the one before, for the browser may be slower than the server.
    if (known?.options === options && !hasColours(known) && this.connection.live) {
      known.late = true;
      return;
    }
    const seq = ++this.#seq;
    const tooMany = tooManyCells(wantedOptions);
    if (tooMany) this.connection.send({ type: "stop", id });
    else if (known?.options === options) this.connection.send({ type: "move", id, seq, observer: place });
    else this.connection.send({ type: "view", id, seq, options: { ...wantedOptions, observer: place } });
    if (known?.options !== options || !this.connection.live) this.#come = null;
    this.#views.set(id, {
      options,
      observer,
      seq,
      begun: known?.begun ?? null,
      cells: tooMany || !this.connection.live ? null : (known?.cells ?? null),
      done: null,
      late: false,
      error: tooMany,
      field: tooMany ? "--cell" : "",
    });
  }

  /**
   * Takes an answer to what the mast was asked last.
   * @param {Message} message
   * @param {(view: MastView) => void} take
   */
  #answered(message, take) {
    const view = this.#views.get(message.id ?? -1);
    if (!view || message.seq !== view.seq || OF_OTHERS.includes(message.of)) return;
    take(view);
    if (view.error) view.cells = this.#come = null;
    this.#tellSoon();
  }

  /** Takes a tile of what its mast was asked last. What is on its way when a move is sent is let go, or pictures would
   * fall behind the hand. @param {import("../server/tile_message.js").Tile} tile */
  #takeTile(tile) {
    const view = this.#views.get(tile.id);
    if (!view || tile.seq !== view.seq || view.begun?.seq !== tile.seq) return;
    if (view.cells !== view.begun) this.#come = null;
    view.cells = view.begun;
    const come = view.cells.take(tile);
    this.#come?.push(come);
    this.#tellSoon();
  }

  #tellSoon() {
    if (this.#told) return;
    this.#told = true;
    requestAnimationFrame(() => {
      const come = this.#come;
      this.#told = false;
      this.#come = [];
      for (const listener of this.#listeners) listener(come);
      this.#askLate();
    });
  }

  /** Sends the moves that waited for a picture of the one before. */
  #askLate() {
    for (const wanted of wantedOf(this.scene.state)) {
      if (this.#views.get(wanted.id)?.late) this.#ask(wanted);
    }
  }
}
