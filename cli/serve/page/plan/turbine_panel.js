// Wind turbines in the column: how many are seen from how much of the ground, their sizes, a layout from a file.

import { element, make } from "../panel/elements.js";
import { inPageWords } from "../panel/page_words.js";
import { areaText, countedText, shareText } from "../panel/words.js";
import { HUBS, TIPS } from "../seen/viewers.js";
import {
  MOST_TURBINES,
  changeTurbine,
  commonSize,
  removeTurbine,
  resizeTurbines,
  rotorOf,
  takeLayout,
  USUAL_SIZE,
} from "../state/turbines.js";
import { takeFiles, warningsOf } from "./tasks_form.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../seen/live_views.js").LiveViews} LiveViews */

const input = (/** @type {string} */ id) => /** @type {HTMLInputElement} */ (element(id));

/** Returns what takes a file with a layout. @param {Scene} scene @param {LiveViews} views
 * @param {import("../server/api.js").Jobs} jobs @param {import("../vendor/ol.js").OlMap} map */
export function makeTurbinePanel(scene, views, jobs, map) {
  makeParts(scene);
  makeSizes(scene);
  makeChosen(scene);
  const button = /** @type {HTMLButtonElement} */ (element("turbine-button"));
  button.addEventListener("click", () => scene.change({ placing: !scene.state.placing }));
  scene.on(["placing", "turbines", "task"], () => {
    const { placing, turbines, task } = scene.state;
    button.setAttribute("aria-pressed", String(placing));
    button.disabled = turbines.length >= MOST_TURBINES;
    if (task === "turbines") element("map").classList.toggle("placing", placing || turbines.length === 0);
  });
  const takeLayoutFile = takeFiles("layout", element("layout-problem"), async (file) => {
    const upload = await jobs.send(file.name, file);
    jobs.forget(upload.name).catch(() => {});
    if (upload.places.length === 0) throw new Error(`${file.name}: has no points, where turbines stand`);
    takeLayout(scene, upload.places);
    const more = upload.places.length - MOST_TURBINES;
    element("layout-problem").textContent =
      (more > 0 ? `The map shows the first ${MOST_TURBINES}; the command line takes all. ` : "") + warningsOf(upload);
    showAll(map, upload.places);
  });
  const sum = element("turbine-sum");
  const tell = () => sum.replaceChildren(...sumParts(scene, views));
  views.onChange(tell);
  scene.on(["turbines"], tell);
  return takeLayoutFile;
}

/** Brings all places into view. @param {import("../vendor/ol.js").OlMap} map @param {{x: number, y: number}[]} places */
function showAll(map, places) {
  const xs = places.map(({ x }) => x);
  const ys = places.map(({ y }) => y);
  const all = [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
  const [west, south, east, north] = map.getView().calculateExtent();
  if (all[0] >= west && all[1] >= south && all[2] <= east && all[3] <= north) return;
  map.getView().fit(all, { padding: [80, 80, 80, 80], maxZoom: map.getView().getZoom() });
}

/** @param {Scene} scene @param {LiveViews} views @returns {(HTMLElement | string)[]} */
function sumParts({ state: { turbines } }, views) {
  if (turbines.length === 0) {
    return ["None yet. Click the map for the first one, and right-click it for more; or load a layout."];
  }
  const error = [TIPS, HUBS].map((id) => views.of(id)?.error).find(Boolean);
  if (error) return [make("span", "problem", inPageWords(error))];
  const seen = [
    { what: "a blade tip", done: views.of(TIPS)?.done },
    { what: "a hub", done: views.of(HUBS)?.done },
  ].flatMap(({ what, done }) => (done ? [`${what} from ${seenText(done)}`] : []));
  const count = `${countedText(turbines.length, "turbine")}`;
  return [seen.length > 0 ? `${count}: ${seen.join(", ")}.` : `${count} …`];
}

/** @param {import("../server/live_connection.js").Message} done */
function seenText({ cells, area_m2 }) {
  return `${areaText(area_m2.visible)} (${shareText(cells.visible, cells.visible + cells.hidden + cells.undecided)})`;
}

/** Whether the map counts blade tips or hubs. @param {Scene} scene */
function makeParts(scene) {
  const inputs = /** @type {HTMLInputElement[]} */ ([...element("parts").querySelectorAll("input")]);
  for (const some of inputs) {
    some.addEventListener("change", () => scene.change({ part: some.value === "hubs" ? "hubs" : "tips" }));
  }
  scene.on(["part"], () => inputs.forEach((some) => (some.checked = some.value === scene.state.part)));
}

/** The sizes of all turbines. @param {Scene} scene */
function makeSizes(scene) {
  const hub = input("hub-height");
  const rotor = input("rotor-diameter");
  const change = () => {
    const sizes = [hub, rotor].map(({ value }) => Number(value));
    const right = sizes.map((size) => size > 0 && Number.isFinite(size));
    [hub, rotor].forEach((field, i) => field.setAttribute("aria-invalid", String(field.value !== "" && !right[i])));
    if (right.every(Boolean)) resizeTurbines(scene, sizes[0], sizes[1]);
  };
  for (const field of [hub, rotor]) field.addEventListener("change", change);
  scene.on(["turbines"], () => {
    const turbines = scene.state.turbines.length > 0 ? scene.state.turbines : [{ ...USUAL_SIZE, ...NOWHERE }];
    const text = (/** @type {number | null} */ size) => (size === null ? "" : String(size));
    hub.value = text(commonSize(turbines, (turbine) => turbine.hub));
    rotor.value = text(commonSize(turbines, rotorOf));
    for (const field of [hub, rotor]) field.placeholder = field.value === "" ? "various" : "";
    hub.disabled = rotor.disabled = scene.state.turbines.length === 0;
  });
}

const NOWHERE = { id: 0, name: "", x: 0, y: 0 };

/** The turbine that is selected. @param {Scene} scene */
function makeChosen(scene) {
  for (const axis of /** @type {("x" | "y")[]} */ (["x", "y"])) {
    const field = input(`turbine-${axis}`);
    field.addEventListener("change", () => {
      const wrong = field.value.trim() === "" || !Number.isFinite(Number(field.value));
      field.setAttribute("aria-invalid", String(wrong));
      if (!wrong) changeTurbine(scene, scene.state.turbine ?? -1, { [axis]: Number(field.value) });
    });
  }
  element("turbine-remove").addEventListener("click", () => removeTurbine(scene, scene.state.turbine ?? -1));
  element("turbines-remove").addEventListener("click", () =>
    scene.change({ turbines: [], turbine: null, viewpoint: null }),
  );
  scene.on(["turbines", "turbine"], () => {
    const chosen = scene.state.turbines.find(({ id }) => id === scene.state.turbine);
    element("turbine").hidden = !chosen;
    if (!chosen) return;
    element("turbine-name").textContent = `Turbine ${chosen.name}`;
    input("turbine-x").value = String(chosen.x);
    input("turbine-y").value = String(chosen.y);
  });
}
