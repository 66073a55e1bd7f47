// The button and the field that say where the next mast goes.

import { element } from "./elements.js";
import { problemText } from "./page_words.js";
import { askPlace } from "../server/api.js";
import { MOST_MASTS, nameIn } from "../state/scene.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../vendor/ol.js").OlMap} OlMap */

/** @param {Scene} scene @param {OlMap} map */
export function makePlaceForm(scene, map) {
  const form = /** @type {HTMLFormElement} */ (element("place-form"));
  const input = /** @type {HTMLInputElement} */ (element("place"));
  const name = /** @type {HTMLInputElement} */ (element("place-name"));
  const problem = element("place-problem");
  const button = /** @type {HTMLButtonElement} */ (element("place-button"));
  button.addEventListener("click", () => scene.change({ placing: !scene.state.placing }));
  form.addEventListener("submit", async (event) => {
    event.preventDefault();
    problem.textContent = "";
    try {
      const { x, y, ground_m, height_m } = await askPlace(asTyped(input.value));
      if (ground_m === null) throw new Error(`'${input.value}': there is no ground in the data`);
      const place = { x, y };
      const called = nameIn(name.value);
      scene.addMast({ ...place, ...(called && { name: called }), ...(height_m === null ? {} : { height: height_m }) });
      showPlace(map, place);
      input.value = name.value = "";
    } catch (error) {
      problem.textContent = problemText(error).replace(/^at /, "");
    }
  });
  scene.on(["placing", "masts", "task"], () => {
    const { placing, masts, task } = scene.state;
    button.setAttribute("aria-pressed", String(placing));
    button.disabled = masts.length >= MOST_MASTS;
    name.placeholder = scene.nextName;
    element("map").classList.toggle("placing", task !== "sites" && (placing || masts.length === 0));
  });
}

/** Writes "317 796 E 185 311 N", as the map tells places, and "317796 185311" as the program reads them.
 * @param {string} text */
function asTyped(text) {
  const told = /^(-?[\d ]+) E (-?[\d ]+) N$/.exec(
    text
      .trim()
      .replaceAll(/[\u2009\u202f\u00a0]/g, " ")
      .replaceAll("−", "-"),
  );
  if (told) return `${told[1].replaceAll(" ", "")},${told[2].replaceAll(" ", "")}`;
  return text.trim().replace(/^(-?[\d.]+) +(-?[\d.]+)$/, "$1,$2");
}

/** Brings a place into view. @param {OlMap} map @param {{x: number, y: number}} place */
function showPlace(map, { x, y }) {
  const [west, south, east, north] = map.getView().calculateExtent();
  if (x < west || x > east || y < south || y > north) map.getView().animate({ center: [x, y], duration: 200 });
}
