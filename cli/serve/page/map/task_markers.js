// The markers of each task: masts, wind turbines, sites that were chosen.

import { metresText } from "../panel/words.js";
import { letterOf } from "../state/mast_letter.js";
import { isMoved, moveSite, selectSite } from "../state/plan.js";
import { changeTurbine, removeTurbine } from "../state/turbines.js";
import { Markers } from "./markers.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../vendor/ol.js").OlMap} OlMap */

/** @param {{name: string, height: number}} mast */
const mastLabel = ({ name, height }) => `${name}, ${metresText(height)} high`;

/** @param {OlMap} map @param {Scene} scene */
export const makeMastMarkers = (map, scene) =>
  new Markers(map, scene, {
    className: "marker",
    keys: ["masts", "selected", "task"],
    marked: ({ task, masts, selected }) =>
      task === "masts" || task === "premises"
        ? masts.map((mast) => ({
            ...mast,
            text: letterOf(mast),
            label: mastLabel(mast),
            selected: mast.id === selected,
          }))
        : [],
    select: (id) => scene.change({ selected: id }),
    move: (id, to) => scene.changeMast(id, to),
    remove: (id) => scene.removeMast(id),
  });

/** @param {OlMap} map @param {Scene} scene */
export const makeTurbineMarkers = (map, scene) =>
  new Markers(map, scene, {
    className: "marker turbine",
    keys: ["turbines", "turbine", "task"],
    marked: ({ task, turbines, turbine }) =>
      task === "turbines"
        ? turbines.map(({ id, name, x, y, tip }, i) => ({
            ...{ id, x, y, hue: 0, text: String(i + 1) },
            label: `Turbine ${name}, ${metresText(tip)} to the blade tip`,
            selected: id === turbine,
          }))
        : [],
    select: (id) => scene.change({ turbine: id }),
    move: (id, to) => changeTurbine(scene, id, to),
    remove: (id) => removeTurbine(scene, id),
  });

/** @param {OlMap} map @param {Scene} scene */
export const makeSiteMarkers = (map, scene) =>
  new Markers(map, scene, {
    className: "marker",
    keys: ["plan", "task"],
    marked: ({ task, plan }) =>
      task === "sites" && plan
        ? plan.sites.map((site, i) => ({
            ...site,
            text: String(i + 1),
            label: mastLabel(site),
            selected: site.id === plan.selected,
            moved: isMoved(site),
          }))
        : [],
    select: (id) => selectSite(scene, id),
    move: (id, to) => moveSite(scene, id, to),
    remove: () => {},
  });
