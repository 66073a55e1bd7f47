// The fields of options: each field's name is the name of an option of the command line, an empty field its default.

import { element } from "./elements.js";
import { onTyped } from "./typed.js";
import { modeNamed, neededIn, withMode } from "../state/mode.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../server/api.js").Info} Info */
/** @typedef {import("../seen/live_views.js").LiveViews} LiveViews */

// Options that contradict each other: to set one clears the others.
const INSTEAD = [["refraction", "effective-earth"]];
const MODE = "mode";

/** @param {Scene} scene @param {Info} info @param {LiveViews} views */
export function makeOptionsForm(scene, info, views) {
  const form = /** @type {HTMLFormElement} */ (element("options"));
  form.addEventListener("submit", (event) => event.preventDefault());
  onTyped(form, (target, left) => {
    if (!(target instanceof HTMLInputElement || target instanceof HTMLSelectElement) || !target.name) return;
    if (!target.checkValidity()) return left && target.setAttribute("aria-invalid", "true");
    if (target.name === MODE) setMode(scene, target.value);
    else setOption(scene, target.name, target.value.trim());
  });
  makeThemeBoxes(scene, info);
  scene.on(["options"], () => fillIn(form, scene.state.options));
  views.onChange(() => showProblems(form, views));
}

/** @param {Scene} scene @param {string} name @param {string} value */
function setOption(scene, name, value) {
  for (const group of INSTEAD.filter((some) => some.includes(name) && value !== "")) {
    for (const other of group.filter((some) => some !== name)) scene.setOption(other, "");
  }
  scene.setOption(name, value);
}

/** @param {Scene} scene @param {string} mode */
function setMode(scene, mode) {
  if (mode === "loss") element("radio").setAttribute("open", "");
  scene.change({ options: withMode(scene.state.options, mode) });
}

/** What fields show while they are empty, where no mode takes something else. @type {WeakMap<HTMLInputElement, string>} */
const usual = new WeakMap();

/** @param {HTMLFormElement} form @param {Record<string, string>} options */
function fillIn(form, options) {
  const mode = modeNamed(options);
  const needed = neededIn(options);
  for (const field of form.elements) {
    if (!(field instanceof HTMLInputElement || field instanceof HTMLSelectElement) || !field.name) continue;
    field.value = field.name === MODE ? mode : (options[field.name] ?? "");
    if (!(field instanceof HTMLInputElement)) continue;
    if (!usual.has(field)) usual.set(field, field.placeholder);
    field.placeholder = needed[field.name] ?? usual.get(field) ?? "";
  }
  element("vertical-error").hidden = mode !== "probability";
  element("radio-unused").hidden = mode === "visible" || mode === "loss";
}

/**
 * Marks the field that the server found wrong.
 * @param {HTMLFormElement} form
 * @param {LiveViews} views
 */
function showProblems(form, views) {
  const wrong = views.all.find((view) => view.error);
  for (const field of form.elements) {
    if (field instanceof HTMLInputElement) {
      field.setAttribute("aria-invalid", String(Boolean(wrong) && wrong?.field === `--${field.name}`));
    }
  }
}

/**
 * A box for each theme that hides: all is the default, and none has a name of its own.
 * @param {Scene} scene
 * @param {Info} info
 */
function makeThemeBoxes(scene, info) {
  const box = element("theme-boxes");
  const names = info.themes.map((theme) => theme.name);
  element("surface").hidden = names.length === 0;
  const inputs = names.map((name) => {
    const label = document.createElement("label");
    const input = document.createElement("input");
    label.className = "check";
    input.type = "checkbox";
    label.append(input, name);
    box.append(label);
    return input;
  });
  box.addEventListener("change", () => {
    const chosen = names.filter((_, i) => inputs[i].checked);
    scene.setOption("themes", chosen.length === names.length ? "" : chosen.length === 0 ? "none" : chosen.join(","));
  });
  scene.on(["options"], () => {
    const { themes = "all" } = scene.state.options;
    inputs.forEach((input, i) => (input.checked = themes === "all" || themes.split(",").includes(names[i])));
  });
}
