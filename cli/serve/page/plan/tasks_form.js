// What is planned: masts, wind turbines, a choice of sites, or the buildings that masts serve.

import { element } from "../panel/elements.js";
import { inPageWords, problemText } from "../panel/page_words.js";
import { UPLOADED } from "../server/api.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../state/scene.js").Task} Task */

const OF_BUILDINGS = ["buildings", "terraces"];

/** Whether the store has buildings. @param {import("../server/api.js").Info} info */
export const hasBuildings = (info) => info.themes.some(({ kind }) => OF_BUILDINGS.includes(kind));

/** @param {Scene} scene @param {import("../server/api.js").Info} info */
export function makeTasksForm(scene, info) {
  const inputs = /** @type {HTMLInputElement[]} */ ([...element("tasks").querySelectorAll("input")]);
  element("premises-task").hidden = !hasBuildings(info);
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

/** Calls `take` with each file that is chosen, and says what is wrong with it. Returns what takes a file.
 * @param {string} id  Of the field for files. @param {HTMLElement} problem @param {(file: File) => Promise<void>} take */
export function takeFiles(id, problem, take) {
  const input = /** @type {HTMLInputElement} */ (element(id));
  const takeFile = async (/** @type {File | undefined} */ file) => {
    problem.textContent = "";
    if (!file) return;
    try {
      await take(file);
    } catch (error) {
      // The planner knows the file by its own name.
      problem.textContent = problemText(error).replace(UPLOADED, file.name);
    }
  };
  input.addEventListener("change", () => {
    const file = input.files?.[0];
    input.value = "";
    takeFile(file);
  });
  return takeFile;
}

/** What is wrong with rows of a file that was sent, in the words of the page.
 * @param {import("../server/api.js").Upload} upload */
export const warningsOf = ({ warnings }) => warnings.map((warning) => `${inPageWords(warning)}.`).join(" ");

/** Takes files that are dropped anywhere on the page, which the browser would open in its place: places for sites where
 * these are planned, else layouts of turbines.
 * @param {Scene} scene @param {Record<"places" | "layout", (file: File) => void>} take */
export function takeDrops(scene, take) {
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    const file = event.dataTransfer?.files[0];
    if (!file) return;
    if (scene.state.task === "sites") return take.places(file);
    scene.change({ task: "turbines", placing: false });
    take.layout(file);
  });
}
