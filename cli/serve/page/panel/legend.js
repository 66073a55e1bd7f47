// What the colours on the map mean, and how much of the ground has them.

import { element, make } from "./elements.js";
import { areaText, shareText } from "./words.js";
import { CUT, UNDECIDED, VISIBLE } from "../seen/seen_cells.js";
import {
  HUES,
  SHARED,
  UNDECIDED_COLOUR,
  UNDECIDED_OPACITY,
  cssColour,
  hueCss,
  meanColour,
  rampColour,
} from "../seen/palette.js";
import { letterOf } from "../state/mast_letter.js";
import { SERVICES } from "../state/premises.js";
import { SLOPE_COLOURS, SLOPE_LIMITS } from "../map/shade.js";
import { sourcesOf } from "../seen/shown.js";
import { tally } from "../seen/tally.js";
import { className } from "../seen/values.js";
import { modeOf, optionsOf, showOf, viewerOf, viewersOf } from "../seen/viewers.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../seen/live_views.js").LiveViews} LiveViews */
/** @typedef {import("../seen/picture.js").Source} Source */
/** @typedef {[colour: string | string[], text: string, opacity?: number]} Entry  Several colours mean the same. */

/** Of so many masts each mixture of colours is told. */
const MOST_TOLD = 3;
const MIXED = 0.9;

/** @param {Scene} scene @param {LiveViews} views */
export function makeLegend(scene, views) {
  const list = element("legend-list");
  const title = element("legend-title");
  const sum = element("legend-sum");
  const slopes = element("slopes");
  const draw = () => {
    const sources = sourcesOf(scene, views);
    const mode = modeOf(scene.state);
    const sloped = scene.state.layers.relief === "slope";
    element("legend").hidden = sources.length === 0 && !sloped;
    slopes.hidden = !sloped;
    title.textContent = sources.length === 0 ? "" : (mode?.title ?? "In sight");
    list.replaceChildren(
      ...(sources.length === 0 ? [] : mode ? valueEntries(mode) : verdictEntries(scene, sources)).map(entryElement),
    );
    sum.textContent =
      sources.length > 1 && views.settled && !mode && scene.state.task !== "sites" ? sumText(scene, sources) : "";
  };
  element("slope-list").replaceChildren(...slopeEntries().map(entryElement));
  views.onChange(draw);
  scene.on(["show", "selected", "layers", "task", "part", "plan", "premises"], draw);
}

/** @returns {Entry[]} */
function slopeEntries() {
  const bounds = [0, ...SLOPE_LIMITS];
  return SLOPE_COLOURS.map((colour, i) => [
    cssColour(colour),
    i < SLOPE_LIMITS.length ? `${bounds[i]}° to ${bounds[i + 1]}°` : `over ${bounds[i]}°`,
    1,
  ]);
}

/** @param {import("../seen/values.js").ValueMode} mode @returns {Entry[]} */
function valueEntries(mode) {
  const count = mode.limits.length + 1;
  return Array.from({ length: count }, (_, i) => [cssColour(rampColour(i, count)), className(mode, i), 0.8]);
}

/** @param {Scene} scene @param {Source[]} sources @returns {Entry[]} */
function verdictEntries(scene, sources) {
  const options = optionsOf(scene.state);
  const show = showOf(scene.state);
  const masts = viewersOf(scene.state);
  const single = sources.length === 1;
  const chosen = viewerOf(scene.state);
  /** @type {Entry[]} */
  const entries = [];
  if (show === "difference" && !single && chosen) {
    const others = masts.filter((mast) => mast !== chosen).map((mast) => HUES[mast.hue]);
    entries.push(
      [hueCss(chosen.hue), `only from ${chosen.name}`],
      [cssColour(SHARED), "from others, too"],
      [cssColour(others[0]), "pale: only from others", 0.3],
    );
  } else {
    for (const mast of masts.filter((some) => show !== "alone" || some === chosen)) {
      entries.push([hueCss(mast.hue), `from ${mast.name}`]);
    }
    if (!single) entries.push(...mixtureEntries(masts));
  }
  if (options.frequency || holds(sources, CUT)) {
    entries.push([hueCss(sources.at(0)?.hue ?? 0), "paler: Fresnel zone cut", 0.3]);
  }
  if (scene.state.task === "premises" && scene.state.premises) entries.push(...premisesEntries(scene.state.premises));
  if (holds(sources, UNDECIDED)) {
    entries.push([cssColour(UNDECIDED_COLOUR), "undecided, behind ground without data", UNDECIDED_OPACITY]);
  }
  return entries;
}

/** @typedef {import("../state/scene.js").Mast} Mast */

/** All sets of two masts or more. @param {Mast[]} masts @returns {Mast[][]} */
const setsOf = (masts) =>
  Array.from({ length: 1 << masts.length }, (_, mask) => masts.filter((__, bit) => mask & (1 << bit)))
    .filter((set) => set.length > 1)
    .sort((a, b) => a.length - b.length);

/** The colours of what several masts see; of many masts those of pairs. @param {Mast[]} masts @returns {Entry[]} */
function mixtureEntries(masts) {
  const colourOf = (/** @type {Mast[]} */ set) => cssColour(meanColour(set.map(({ hue }) => HUES[hue])));
  if (masts.length > MOST_TOLD) {
    return [
      [
        setsOf(masts)
          .filter(({ length }) => length === 2)
          .map(colourOf),
        "mixtures: from several",
        MIXED,
      ],
    ];
  }
  const all = masts.length === 2 ? "from both" : "from all";
  return setsOf(masts).map((set) => [
    colourOf(set),
    set.length === masts.length ? all : `from ${set.map(letterOf).join(" and ")}`,
    MIXED,
  ]);
}

/** What dots on buildings mean. @param {import("../state/premises.js").Building[]} buildings @returns {Entry[]} */
const premisesEntries = (buildings) =>
  SERVICES.filter(({ service }) => buildings.some((building) => building.service === service)).map(
    ({ colour, text }) => [colour, `building ${text}`, 1],
  );

/** Whether any mast has a cell of this verdict. @param {Source[]} sources @param {number} verdict */
const holds = (sources, verdict) => sources.some(({ cells }) => cells.verdicts & (1 << verdict));

/** @param {Entry} entry */
export function entryElement([colours, text, opacity = 0.65]) {
  const item = make("li");
  const swatches = [colours].flat().map((colour) => {
    const swatch = make("span", "swatch");
    swatch.style.setProperty("--colour", colour);
    swatch.style.setProperty("--opacity", String(opacity));
    return swatch;
  });
  const box = make("span", "swatches");
  box.append(...swatches);
  item.append(box, text);
  return item;
}

const isClear = (/** @type {number} */ verdict) => verdict === VISIBLE;

/** @param {Scene} scene @param {Source[]} sources */
function sumText(scene, sources) {
  // As masts and sites count: with a frequency what has a clear Fresnel zone.
  const { frequency } = optionsOf(scene.state);
  const { any, all, onlySelected, looked, area } = tally(sources, frequency ? isClear : undefined);
  const part = (/** @type {number} */ cells) => `${areaText(cells * area)} (${shareText(cells, looked)})`;
  const what = frequency ? "Zone clear from" : "From";
  if (showOf(scene.state) === "difference") return `${scene.mast?.name} alone adds ${part(onlySelected)}.`;
  return `${what} any ${part(any)}, ${frequency ? "" : "from "}all ${part(all)} of what any looks at.`;
}
