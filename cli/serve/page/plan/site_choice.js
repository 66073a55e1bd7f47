// The choice of sites: made by the server, shown with what each adds, and compared with what the planner makes of it.

import { element, make } from "../panel/elements.js";
import { areaText, numberText, shareText } from "../panel/words.js";
import { hueCss } from "../seen/palette.js";
import { VISIBLE } from "../seen/seen_cells.js";
import { sourcesOf } from "../seen/shown.js";
import { tally } from "../seen/tally.js";
import { MOST_SITES, haveHeights, isMoved, polygonText, putBack, selectSite, sitesOf } from "../state/plan.js";
import { MOST_MASTS } from "../state/scene.js";
import { jobOptions } from "./job_options.js";
import { JobRun } from "./job_run.js";
import { placesIn } from "./tables.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../state/plan.js").Plan} Plan */
/** @typedef {import("../state/plan.js").Search} Search */
/** @typedef {import("../seen/live_views.js").LiveViews} LiveViews */
/** @typedef {import("../server/api.js").Job} Job */

const SITES = "sites";
const field = (/** @type {string} */ id) => /** @type {HTMLInputElement} */ (element(id)).value.trim();

/** @param {Search} search @returns {Record<string, string>} */
function searchOptions(search) {
  const spacing = { spacing: field("site-spacing") };
  if ("ring" in search) return { "search-area": polygonText(search.ring), ...spacing };
  if (search.places.length === 0) return { "search-area": search.upload, ...spacing };
  const named = search.places.every(({ name }) => name);
  return { candidates: search.upload, ...(named ? { "name-field": "name" } : {}) };
}

/** @param {Scene} scene @returns {Promise<import("./job_run.js").Call>} */
async function siteCall({ state: { search, options } }) {
  if (!search) throw new Error("Say where masts may stand: draw an area, or load places.");
  const count = Number(field("site-count"));
  if (!(Number.isInteger(count) && count >= 1 && count <= MOST_SITES)) {
    throw new Error(`The map shows from 1 to ${MOST_SITES} sites; the command line takes more.`);
  }
  return {
    verb: "site",
    options: {
      ...jobOptions("site", options),
      ...searchOptions(search),
      ...(haveHeights(search) ? {} : { "mast-height": field("site-height") }),
      ...{ count: field("site-count"), output: SITES },
    },
    uploads: [],
  };
}

/** @param {Job} job @param {number} cell @returns {Promise<Plan>} */
async function planOf({ document, files }, cell) {
  const sites = sitesOf(document.chosen);
  const table = files.find(({ name }) => name === `${SITES}/candidates.csv`);
  const candidates = table ? placesIn(await (await fetch(table.url)).text()) : [];
  const result = { value: document.value, demand: document.demand, gap: document.gap_percent, cell };
  return { sites, selected: sites[0]?.id ?? -1, candidates, result };
}

/** @param {Scene} scene @param {LiveViews} views @param {import("../server/api.js").Jobs} jobs */
export function makeSiteChoice(scene, views, jobs) {
  const button = /** @type {HTMLButtonElement} */ (element("choose"));
  const run = new JobRun(element("choice-run"), jobs, "Choosing sites");
  button.addEventListener("click", async () => {
    const cell = Number(scene.state.options.cell);
    scene.change({ plan: null });
    const job = await run.run(() => siteCall(scene));
    if (job) scene.change({ plan: await planOf(job, cell) });
  });
  element("plan-back").addEventListener("click", () => putBack(scene));
  element("plan-keep").addEventListener("click", () => keepAsMasts(scene));
  scene.on(["search"], () => run.forgive());
  scene.on(["plan"], () => showPlan(scene));
  views.onChange(() => showNow(scene, views));
}

/** The sites become masts, beside those there are; all or none, for the map shows only so many. @param {Scene} scene */
function keepAsMasts(scene) {
  const sites = scene.state.plan?.sites ?? [];
  const room = MOST_MASTS - scene.state.masts.length;
  if (sites.length > room) {
    const most = `The map shows ${MOST_MASTS} masts, and ${scene.state.masts.length} are there: remove some first.`;
    element("plan-now").textContent = most;
    return;
  }
  for (const { name, x, y, height } of sites) scene.addMast({ x, y, name, height });
  scene.change({ target: null, task: "masts", show: "together" });
}

/** @param {Scene} scene */
function showPlan(scene) {
  const { plan, options } = scene.state;
  element("plan").hidden = !plan;
  if (!plan) return;
  element("plan-sum").textContent = sumText(plan, Number(options.radius));
  const most = Math.max(...plan.sites.map(({ gain }) => gain));
  element("plan-sites").replaceChildren(...plan.sites.map((site, i) => siteItem(scene, site, i, most)));
}

/** @param {Plan} plan @param {number} radius */
function sumText({ sites, result: { value, demand, gap, cell } }, radius) {
  const one = sites.length === 1;
  const proof = gap > 0 ? `No choice serves more than ${numberText(gap, 1)} % beyond that` : "No choice serves more";
  return (
    `${one ? "The site serves" : `The ${sites.length} sites serve`} ${areaText(value * cell ** 2)}, ` +
    `${shareText(value, demand)} of what lies within ${radius / 1000} km of a candidate. ${proof}.`
  );
}

/** @param {Scene} scene @param {import("../state/plan.js").Site} site @param {number} place @param {number} most */
function siteItem(scene, site, place, most) {
  const { result, selected } = /** @type {Plan} */ (scene.state.plan);
  const item = make("li");
  const button = make("button", "site");
  button.type = "button";
  button.style.setProperty("--hue", hueCss(site.hue));
  button.style.setProperty("--share", String(most > 0 ? site.gain / most : 0));
  button.setAttribute("aria-pressed", String(site.id === selected));
  button.append(
    make("span", "dot", String(place + 1)),
    make("span", "mast-name", site.name),
    make("span", "site-gain", `${isMoved(site) ? "moved; added" : "adds"} ${areaText(site.gain * result.cell ** 2)}`),
    make("span", "site-bar"),
  );
  button.addEventListener("click", () => selectSite(scene, site.id));
  item.append(button);
  return item;
}

/** What the sites serve where they stand now, and what moving them costs. @param {Scene} scene @param {LiveViews} views */
function showNow(scene, views) {
  const { plan, task } = scene.state;
  if (!plan || task !== "sites" || !views.settled) return;
  const now = element("plan-now");
  const moved = plan.sites.filter(isMoved);
  const error = plan.sites.map(({ id }) => views.of(id)?.error).find(Boolean);
  const sources = sourcesOf(scene, views);
  /** @type {HTMLButtonElement} */ (element("plan-back")).disabled = moved.length === 0;
  if (error || sources.length < plan.sites.length) {
    now.textContent = error ?? "";
    return;
  }
  const served = tally(sources, (verdict) => verdict === VISIBLE).any * sources[0].cells.cell ** 2;
  const before = plan.result.value * plan.result.cell ** 2;
  now.textContent =
    moved.length === 0
      ? "Drag a site, or select one and click another candidate, to see what that costs."
      : `Now ${areaText(served)}: ${changeText(served - before, before)} the choice.`;
}

/** @param {number} change @param {number} before */
function changeText(change, before) {
  if (change === 0) return "as much as";
  return `${areaText(Math.abs(change))} (${shareText(Math.abs(change), before)}) ${change < 0 ? "less" : "more"} than`;
}
