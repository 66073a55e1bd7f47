// Tiles of the ground's heights, as the server sends them and kept for a while.

import { messageOf } from "../panel/words.js";

/** @typedef {import("../server/api.js").Info} Info */
/**
 * @typedef {{heights: Float32Array, width: number}} HeightTile  Rows from the north-west, with a border of pixels
 *   around.
 */

const MOST_TILES = 400;

export class HeightTiles {
  /** @type {Map<string, Promise<HeightTile | null>>} */
  #tiles = new Map();
  /** @type {(problem: string) => void}  Gets what is wrong with the ground, or nothing once it is there. */
  onProblem = () => {};

  /** @param {Info} info */
  constructor(info) {
    this.info = info;
    this.border = info.tiles.border;
    this.size = info.tiles.size;
    this.resolutions = info.tiles.resolutions;
  }

  /** The tile, or null where the data ends. @param {number} z @param {number} x @param {number} y */
  get(z, x, y) {
    const name = `${z}/${x}/${y}`;
    const kept = this.#tiles.get(name) ?? this.#load(name);
    this.#tiles.delete(name);
    this.#tiles.set(name, kept); // the last used are last
    if (this.#tiles.size > MOST_TILES) this.#tiles.delete([...this.#tiles.keys()][0]);
    return kept;
  }

  /** @param {string} name @returns {Promise<HeightTile | null>} */
  async #load(name) {
    try {
      const answer = await fetch(`/tiles/heights/${name}?v=${encodeURIComponent(this.info.version)}`);
      if (answer.status === 204) return null;
      if (!answer.ok) throw new Error((await answer.json()).error);
      this.onProblem("");
      return { heights: new Float32Array(await answer.arrayBuffer()), width: this.size + 2 * this.border };
    } catch (problem) {
      this.#tiles.delete(name);
      this.onProblem(messageOf(problem));
      throw problem;
    }
  }

  /** The highest of the finest tiles' ground within a distance of a place.
   * @param {number} x @param {number} y @param {number} within @returns {Promise<{x: number, y: number} | null>} */
  async highest(x, y, within) {
    const z = this.resolutions.length - 1;
    const r = this.resolutions[z];
    const [west, north] = this.info.tiles.origin;
    let best = null;
    let height = -Infinity;
    const column = (/** @type {number} */ e) => Math.floor((e - west) / r);
    const row = (/** @type {number} */ n) => Math.floor((north - n) / r);
    for (let j = row(y + within); j <= row(y - within); ++j) {
      for (let i = column(x - within); i <= column(x + within); ++i) {
        const at = { x: west + (i + 0.5) * r, y: north - (j + 0.5) * r };
        if (Math.hypot(at.x - x, at.y - y) > within) continue;
        const found = await this.#pixel(z, i, j);
        if (found > height) [best, height] = [at, found];
      }
    }
    return best;
  }

  /** @param {number} z @param {number} column @param {number} row @returns {Promise<number>} */
  async #pixel(z, column, row) {
    const x = Math.floor(column / this.size);
    const y = Math.floor(row / this.size);
    const tile = await this.get(z, x, y);
    if (!tile) return NaN;
    return tile.heights[(row - y * this.size + this.border) * tile.width + column - x * this.size + this.border];
  }
}
