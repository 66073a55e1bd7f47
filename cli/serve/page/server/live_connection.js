// The WebSocket to the server: says hello with the key, and connects again when the line is lost.

import { readTiles } from "./tile_message.js";

/** @typedef {import("./tile_message.js").Tile} Tile */
/** @typedef {{type: string, id?: number, seq?: number, [field: string]: any}} Message */
/** @typedef {"connecting" | "live" | "lost" | "refused"} LineState */

const WRONG_KEY = 1008;
const FIRST_WAIT = 250;
const LONGEST_WAIT = 4000;

export class LiveConnection {
  /** @type {Map<string, ((message: Message) => void)[]>} */
  #listeners = new Map();
  /** @type {WebSocket | null} */
  #socket = null;
  #wait = FIRST_WAIT;
  #live = false;
  /** @type {(tile: Tile) => void} */
  onTile = () => {};
  /** @type {(state: LineState, why: string) => void} */
  onState = () => {};

  /** @param {string} key */
  constructor(key) {
    this.key = key;
  }

  /** Whether the server hears what is sent. */
  get live() {
    return this.#live;
  }

  /** @param {string} type @param {(message: Message) => void} listener */
  on(type, listener) {
    this.#listeners.set(type, [...(this.#listeners.get(type) ?? []), listener]);
  }

  /** Does nothing while there is no connection: who listens to `welcome` asks anew. @param {object} message */
  send(message) {
    if (this.#live) this.#socket?.send(JSON.stringify(message));
  }

  connect() {
    this.onState("connecting", "");
    const socket = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/live`);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => socket.send(JSON.stringify({ type: "hello", key: this.key }));
    socket.onmessage = ({ data }) =>
      typeof data === "string" ? this.#take(JSON.parse(data)) : readTiles(data).forEach(this.onTile);
    socket.onclose = ({ code, reason }) => this.#closed(code, reason);
    this.#socket = socket;
  }

  /** @param {Message} message */
  #take(message) {
    if (message.type === "welcome") {
      this.#live = true;
      this.#wait = FIRST_WAIT;
      this.onState("live", "");
    }
    for (const listener of this.#listeners.get(message.type) ?? []) listener(message);
  }

  /** @param {number} code @param {string} reason */
  #closed(code, reason) {
    const greeted = this.#live;
    this.#live = false;
    if (code === WRONG_KEY && !greeted) return this.onState("refused", reason);
    this.onState("lost", reason);
    setTimeout(() => this.connect(), this.#wait);
    this.#wait = Math.min(LONGEST_WAIT, 2 * this.#wait);
  }
}
