// How much of what is looked at is undecided, why, and the choice that decides it: what ground without data does to lines
// of sight.

import { element } from "./elements.js";
import { areaText, shareText } from "./words.js";
import { TIPS, viewerOf } from "../seen/viewers.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../seen/live_views.js").LiveViews} LiveViews */

const NODATA = "nodata";
/** What such ground is taken to do, by the option's values. @type {Record<string, string>} */
const TAKEN = {
  block: "Ground without data is taken to hide what lies behind it.",
  clear: "Lines of sight pass over ground without data as if nothing stood there.",
};

/** @param {Scene} scene @param {LiveViews} views */
export function makeUndecided(scene, views) {
  const box = element("undecided");
  const said = element("undecided-said");
  const buttons = /** @type {HTMLButtonElement[]} */ ([...box.querySelectorAll("button")]);
  for (const button of buttons) {
    button.addEventListener("click", () => scene.setOption(NODATA, button.value));
  }
  const show = () => {
    const viewer = viewerOf(scene.state);
    const done = views.of(scene.state.task === "turbines" ? TIPS : (viewer?.id ?? -1))?.done;
    const { nodata = "" } = scene.state.options;
    if (!done && views.all.length > 0) return; // what was said holds until more is known
    said.textContent = done ? textOf(done, nodata, viewer?.name) : "";
    box.hidden = said.textContent === "";
    for (const button of buttons) button.hidden = button.value === nodata;
  };
  views.onChange(show);
  scene.on(["selected", "task", "plan"], show);
}

/** @param {import("../server/live_connection.js").Message} done @param {string} nodata
 * @param {string} [name]  Of who looks. */
function textOf({ cells, area_m2 }, nodata, name) {
  if (nodata in TAKEN) return TAKEN[nodata];
  if (!(cells.undecided > 0)) return "";
  const looked = cells.visible + cells.hidden + cells.undecided + (cells.zone_cut ?? 0);
  const much = `${areaText(area_m2.undecided)} (${shareText(cells.undecided, looked)})`;
  return `${name ? `${name}: ` : ""}${much} is undecided, as lines of sight there cross ground without data. Say what such ground does:`;
}
