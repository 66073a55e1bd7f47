// The choice of sites: made by the server, shown with what each adds, and compared with what the planner makes of it.

import { element, make } from "../panel/elements.js";
import { inPageWords } from "../panel/page_words.js";
import { areaText, countedText, numberText, shareText } from "../panel/words.js";
import { hueCss } from "../seen/palette.js";
import { VISIBLE } from "../seen/seen_cells.js";
import { sourcesOf } from "../seen/shown.js";
import { countServed, tally } from "../seen/tally.js";
import { MOST_SITES, haveHeights, isMoved, polygonText, putBack, selectSite, sitesOf } from "../state/plan.js";
import { MOST_MASTS } from "../state/scene.js";
import { jobOptions } from "./job_options.js";
import { JobRun } from "./job_run.js";
import { servedCall } from "./served_form.js";
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

/** @typedef {{scene: Scene, views: LiveViews, map: import("../vendor/ol.js").OlMap,
 *    info: import("../server/api.js").Info, jobs: import("../server/api.js").Jobs}} World */

/** @param {World} world @returns {Promise<{call: import("./job_run.js").Call, asked: import("./served_form.js").Asked}>} */
async function siteCall({ scene, map, info, jobs }) {
  const { search, options } = scene.state;
  if (!search) throw new Error("Say where masts may stand: draw an area, or load places.");
  const count = Number(field("site-count"));
  if (!(Number.isInteger(count) && count >= 1 && count <= MOST_SITES)) {
    throw new Error(`The map shows from 1 to ${MOST_SITES} sites; the command line takes more.`);
  }
  const served = await servedCall(scene, map, info, jobs);
  const call = {
    verb: "site",
    options: {
      ...jobOptions("site", options),
      ...searchOptions(search),
      ...(haveHeights(search) ? {} : { "mast-height": field("site-height") }),
      ...{ count: field("site-count"), output: SITES },
      ...served.options,
    },
    uploads: served.uploads,
  };
  return { call, asked: served.asked };
}

/** @param {Job} job @param {Pick<Plan["result"], "cell" | "asked" | "wanted">} asked @returns {Promise<Plan>} */
async function planOf({ document, files }, asked) {
  const sites = sitesOf(document.chosen);
  const table = files.find(({ name }) => name === `${SITES}/candidates.csv`);
  const candidates = table ? placesIn(await (await fetch(table.url)).text()) : [];
  const result = { value: document.value, demand: document.demand, gap: document.gap_percent, ...asked };
  return { sites, selected: sites[0]?.id ?? -1, candidates, result };
}

/** @param {World} world */
export function makeSiteChoice(world) {
  const { scene, views, jobs } = world;
  const button = /** @type {HTMLButtonElement} */ (element("choose"));
  const run = new JobRun(element("choice-run"), jobs, "Choosing sites");
  button.addEventListener("click", async () => {
    const [cell, count] = [Number(scene.state.options.cell), Number(field("site-count"))];
    scene.change({ plan: null });
    /** @type {import("./served_form.js").Asked | null} */
    let asked = null;
    const job = await run.run(async () => {
      const wanted = await siteCall(world);
      asked = wanted.asked;
      return wanted.call;
    });
    if (job && asked) scene.change({ plan: await planOf(job, { cell, asked, wanted: count }) });
  });
  element("plan-back").addEventListener("click", () => putBack(scene));
  element("plan-keep").addEventListener("click", () => keepAsMasts(scene));
  const FIELDS = ["site-count", "site-height", "site-spacing"];
  run.follow(scene, ["search", "served", "options"], () => [
    scene.state.search,
    scene.state.served,
    jobOptions("site", scene.state.options),
    ...FIELDS.map(field),
  ]);
  for (const name of FIELDS) element(name).addEventListener("change", () => run.compare());
  scene.on(["search", "served"], () => run.forgive());
  scene.on(["plan"], () => showPlan(scene));
  views.onChange(() => showNow(scene, views));
}

/** The sites become masts, beside those there are; all or none, for the map shows only so many. @param {Scene} scene */
function keepAsMasts(scene) {
  const { masts, plan } = scene.state;
  const isThere = (/** @type {import("../state/plan.js").Site} */ site) =>
    masts.some(
      ({ name, x, y, height }) => name === site.name && x === site.x && y === site.y && height === site.height,
    );
  const sites = (plan?.sites ?? []).filter((site) => !isThere(site));
  const room = MOST_MASTS - masts.length;
  if (sites.length > room) {
    const most = `The map shows ${MOST_MASTS} masts, and ${masts.length} are there: remove some first.`;
    element("plan-now").textContent = most;
    return;
  }
  for (const { name, x, y, height } of sites) scene.addMast({ x, y, name, height });
  scene.change({ target: null, task: "masts", show: "together" });
}

/** @param {Scene} scene */
function showPlan(scene) {
  const { plan } = scene.state;
  element("plan").hidden = !plan;
  if (!plan) return;
  element("plan-sum").textContent = sumText(plan);
  const most = Math.max(...plan.sites.map(({ gain }) => gain));
  element("plan-sites").replaceChildren(...plan.sites.map((site, i) => siteItem(scene, site, i, most)));
}

/** So much of what is served, in its own unit. @param {number} value @param {Plan["result"]} result */
function amountText(value, { cell, asked }) {
  return asked.unit === "ground" ? areaText(value * cell ** 2) : countedText(value, asked.unit);
}

/** @param {Plan} plan */
function sumText({ sites, candidates, result }) {
  const { value, demand, gap, asked, wanted } = result;
  const why = sites.length < candidates.length ? "one more would add nothing" : "there are no more candidates";
  const all = sites.length < wanted ? ` ${wanted} were asked for: ${why}.` : "";
  const one = sites.length === 1;
  const proof = gap > 0 ? `No choice serves more than ${numberText(gap, 1)} % beyond that` : "No choice serves more";
  return (
    `${one ? "The site serves" : `The ${sites.length} sites serve`} ${amountText(value, result)}: ` +
    `${shareText(value, demand)} of ${asked.what} (${amountText(demand, result)}). ${proof}.${all}`
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
    make("span", "site-gain", `${isMoved(site) ? "moved; added" : "adds"} ${amountText(site.gain, result)}`),
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
    now.textContent = inPageWords(error ?? "");
    return;
  }
  const what = plan.result.asked.unit === "ground" ? "" : ` ${plan.result.asked.unit}s`;
  const served = servedNow(plan, sources);
  if (served === null) {
    now.textContent = moved.length === 0 ? "" : `Choose sites again to see how many${what} these serve.`;
    return;
  }
  // What the map tells of places is that of their cells: what is compared is told alike.
  const exact = plan.result.asked.unit === "ground";
  if (moved.length === 0) shownOfChoice.set(plan.result, served);
  const before = exact ? plan.result.value : (shownOfChoice.get(plan.result) ?? plan.result.value);
  now.textContent =
    moved.length === 0
      ? "Drag a site, or select one and click another candidate, to see what that costs."
      : `Now ${exact ? "" : "about "}${amountText(served, plan.result)}: ${changeText(served - before, before, plan.result)} the choice.`;
}

/** What the map shows of each choice as it was made. @type {WeakMap<Plan["result"], number>} */
const shownOfChoice = new WeakMap();

/** How much the sites serve where they stand now; null where the page cannot tell.
 * @param {Plan} plan @param {import("../seen/picture.js").Source[]} sources */
function servedNow({ result: { asked } }, sources) {
  const serves = (/** @type {number} */ verdict) => verdict === VISIBLE;
  if (asked.points) return countServed(asked.points, sources, serves);
  return asked.unit === "ground" ? tally(sources, serves).any : null;
}

/** @param {number} change @param {number} before @param {Plan["result"]} result */
function changeText(change, before, result) {
  if (change === 0) return "as much as";
  return `${amountText(Math.abs(change), result)} (${shareText(Math.abs(change), before)}) ${change < 0 ? "less" : "more"} than`;
}
