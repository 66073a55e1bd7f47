// Buttons and keys that take back what was planned by mistake.

import { element } from "./elements.js";
import { History, PLANNED } from "../state/history.js";

/** Whether a key belongs to the text that is being typed. @param {EventTarget | null} target */
const isTyping = (target) => target instanceof HTMLInputElement && target.type === "text" && target.value !== "";

/** @param {KeyboardEvent} event @returns {"undo" | "redo" | null} */
function meaningOf({ key, ctrlKey, metaKey, shiftKey }) {
  if (!ctrlKey && !metaKey) return null;
  if (key.toLowerCase() === "z") return shiftKey ? "redo" : "undo";
  return key.toLowerCase() === "y" ? "redo" : null;
}

/** @param {import("../state/scene.js").Scene} scene */
export function makeUndo(scene) {
  const history = new History(scene);
  const undo = /** @type {HTMLButtonElement} */ (element("undo"));
  const redo = /** @type {HTMLButtonElement} */ (element("redo"));
  const show = () => {
    undo.disabled = !history.canUndo;
    redo.disabled = !history.canRedo;
  };
  // A key that is held moves on, and letters of a text belong together.
  const begins = (/** @type {Event} */ event) =>
    !(event instanceof KeyboardEvent) || (!event.repeat && !meaningOf(event) && !isTyping(event.target));
  for (const gesture of ["pointerdown", "click", "contextmenu", "keydown", "change", "drop"]) {
    addEventListener(gesture, (event) => begins(event) && history.begin(), { capture: true });
  }
  undo.addEventListener("click", () => history.undo());
  redo.addEventListener("click", () => history.redo());
  addEventListener("keydown", (event) => {
    const meaning = meaningOf(event);
    if (!meaning || isTyping(event.target)) return;
    event.preventDefault();
    history[meaning]();
  });
  scene.on([...PLANNED], show);
}
