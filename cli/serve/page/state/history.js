// What was planned before, to go back to: the scene as it was before each gesture of the planner that changed it.

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./scene.js").SceneState} SceneState */

/** What makes a step, and what comes back with it. */
export const PLANNED = /** @type {const} */ ([
  ...["masts", "target", "options", "turbines", "viewpoint", "search", "served", "siting", "plan"],
]);
const BESIDE = /** @type {const} */ (["task", "selected", "show", "turbine", "part"]);
const MOST_STEPS = 100;

export class History {
  /** @type {SceneState[]} */
  #past = [];
  /** @type {SceneState[]} */
  #future = [];

  /** @param {Scene} scene */
  constructor(scene) {
    this.scene = scene;
    this.#before = scene.state;
  }

  /** The scene before the gesture that is under way. @type {SceneState} */
  #before;

  /** Says that a gesture begins: what it changes, once or many times, is one step. */
  begin() {
    if (this.#changed) {
      this.#past = [...this.#past, this.#before].slice(-MOST_STEPS);
      this.#future = [];
    }
    this.#before = this.scene.state;
  }

  get canUndo() {
    return this.#changed || this.#past.length > 0;
  }

  get canRedo() {
    return !this.#changed && this.#future.length > 0;
  }

  undo() {
    this.begin();
    this.#go(this.#past, this.#future);
  }

  redo() {
    this.begin();
    this.#go(this.#future, this.#past);
  }

  get #changed() {
    return PLANNED.some((part) => this.scene.state[part] !== this.#before[part]);
  }

  /** @param {SceneState[]} from @param {SceneState[]} to */
  #go(from, to) {
    const state = from.pop();
    if (!state) return;
    to.push(this.#before);
    this.#before = {
      ...this.#before,
      ...Object.fromEntries([...PLANNED, ...BESIDE].map((part) => [part, state[part]])),
    };
    this.scene.change({ ...this.#before, placing: false });
  }
}
