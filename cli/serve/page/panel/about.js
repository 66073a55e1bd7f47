// What the store holds, so that a planner knows what the answers rest on.

import { element, make } from "./elements.js";
import { countedText, distanceText, metresText, numberText } from "./words.js";

/** @typedef {import("../server/api.js").Info} Info */

/** @param {Info} info */
export function showStore(info) {
  document.title = `${info.store} · itin`;
  element("store").textContent = info.store;
  element("crs").textContent = [info.crs_name, info.crs].filter(Boolean).join(", ");
  element("about").append(...factsOf(info).flatMap(([name, text]) => [make("dt", "", name), make("dd", "", text)]));
}

/** @param {Info} info @returns {[string, string][]} */
function factsOf({ bounds: { xmin, ymin, xmax, ymax }, data_spacing_m, themes, itin }) {
  const facts = /** @type {[string, string][]} */ ([
    ["Extent", `${distanceText(xmax - xmin)} by ${distanceText(ymax - ymin)}`],
  ]);
  if (data_spacing_m !== null) facts.push(["Terrain", `a height every ${metresText(data_spacing_m)}`]);
  for (const { name, features, left_out = 0 } of themes) {
    const absent = left_out > 0 ? `; ${numberText(left_out)} more do not stand, as the import left them out` : "";
    facts.push([name, countedText(features, "feature") + absent]);
  }
  if (themes.length === 0) facts.push(["Features", "none: buildings and trees do not hide"]);
  return [...facts, ["itin", itin]];
}
