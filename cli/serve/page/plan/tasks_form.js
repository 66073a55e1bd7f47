// What is planned: masts, wind turbines, a choice of sites, or the buildings that masts serve.

import { element } from "../panel/elements.js";
import { messageOf } from "../panel/words.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../state/scene.js").Task} Task */

const BUILDINGS = "buildings";

/** @param {Scene} scene @param {import("../server/api.js").Info} info */
export function makeTasksForm(scene, info) {
  const inputs = /** @type {HTMLInputElement[]} */ ([...element("tasks").querySelectorAll("input")]);
  element("premises-task").hidden = !info.themes.some(({ kind }) => kind === BUILDINGS);
  for (const input of inputs) {
    input.addEventListener("change", () => {
      scene.change({ task: /** @type {Task} */ (input.value), placing: false });
    });
  }
  scene.on(["task"], () => {
    document.body.dataset.task = scene.state.task;
    inputs.forEach((input) => (input.checked = input.value === scene.state.task));
  });
}

/** Calls `take` with each file that is chosen, and says what is wrong with it.
 * @param {string} id  Of the field for files. @param {HTMLElement} problem @param {(file: File) => Promise<void>} take */
export function takeFiles(id, problem, take) {
  const input = /** @type {HTMLInputElement} */ (element(id));
  input.addEventListener("change", async () => {
    const file = input.files?.[0];
    input.value = "";
    problem.textContent = "";
    if (!file) return;
    try {
      await take(file);
    } catch (error) {
      // The planner knows the file by its own name.
      problem.textContent = messageOf(error).replace(/upload-\d+\.\w+/g, file.name);
    }
  });
}
