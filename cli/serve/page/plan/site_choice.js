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
import { askedOf, servedCall } from "./served_form.js";
import { placesIn } from "./tables.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../state/plan.js").Plan} Plan */
/** @typedef {import("../state/plan.js").Search} Search */
/** @typedef {import("../state/served.js").Served} Served */
/** @typedef {import("../seen/live_views.js").LiveViews} LiveViews */
/** @typedef {import("../server/api.js").Job} Job */

const SITES = "sites";

/** @param {Search} search @param {string} spacing @returns {Record<string, string>} */
function searchOptions(search, spacing) {
  if ("ring" in search) return { "search-area": polygonText(search.ring), spacing };
  if (search.places.length === 0) return { "search-area": search.upload, spacing };
  const named = search.places.every(({ name }) => name);
  return { candidates: search.upload, ...(named ? { "name-field": "name" } : {}) };
}

/** @typedef {{scene: Scene, views: LiveViews, map: import("../vendor/ol.js").OlMap,
 *    info: import("../server/api.js").Info, jobs: import("../server/api.js").Jobs}} World */

/** The options of a choice, but for what is to be served. @param {import("../state/scene.js").SceneState} state
 * @returns {Record<string, string>} */
function siteOptions({ search, siting, options }) {
  return {
    ...jobOptions("site", options),
    ...(search ? searchOptions(search, siting.spacing) : {}),
    ...(haveHeights(search) ? {} : { "mast-height": siting.height }),
    ...{ count: siting.count, output: SITES },
  };
}

/** @param {World} world @returns {Promise<import("./job_run.js").Call>} */
async function siteCall({ scene, map, info, jobs }) {
  const { search, siting } = scene.state;
  if (!search) throw new Error("Say where masts may stand: draw an area, or load places.");
  const count = Number(siting.count);
  if (!(Number.isInteger(count) && count >= 1 && count <= MOST_SITES)) {
    throw new Error(`The map shows from 1 to ${MOST_SITES} sites; the command line takes more.`);
  }
  const served = await servedCall(scene, map, info, jobs);
  return { verb: "site", options: { ...siteOptions(scene.state), ...served.options }, uploads: served.uploads };
}

/** The choice that a call has made. @param {Job} job @param {Served} served  What was to be served.
 * @returns {Promise<Plan>} */
export async function planOf(job, served) {
  const { document, files } = job;
  const { cell_m: cell, count: wanted, radius_m: radius } = document.command;
  const asked = askedOf(served, radius);
  const placesOf = async (/** @type {string} */ table) => {
    const file = files.find(({ name }) => name === `${SITES}/${table}`);
    return file ? placesIn(await (await fetch(file.url)).text()) : null;
  };
  const sites = sitesOf(document.chosen);
  const result = { value: document.value, demand: document.demand, gap: document.gap_percent, cell, wanted, asked };
  return {
    ...{ sites, selected: sites[0]?.id ?? -1, job },
    candidates: (await placesOf("candidates.csv")) ?? [],
    result: { ...result, points: asked.unit === "building" ? null : await placesOf("demand.csv") },
  };
}

/** What a choice depends on, in one order. @param {Served} served @param {import("../server/api.js").Options} options */
function dependsOn({ kind, ...served }, { demand: _, ...options }) {
  const what = "ring" in served ? served.ring : "upload" in served ? served.upload : null;
  return [kind, what, Object.entries(options).sort()];
}

/** @param {World} world @param {string} gone  Says of a choice in the page's address that it is not there any more; else
 *   empty. */
export function makeSiteChoice(world, gone) {
  const { scene, views, jobs } = world;
  const run = new JobRun(element("choice-run"), jobs, "Choosing sites");
  element("choose").addEventListener("click", async () => {
    const { served } = scene.state;
    scene.change({ plan: null });
    const job = await run.run(() => siteCall(world));
    if (job) scene.change({ plan: await planOf(job, served) });
  });
  element("plan-back").addEventListener("click", () => putBack(scene));
  element("plan-keep").addEventListener("click", () => keepAsMasts(scene));
  run.follow(scene, ["search", "served", "options", "siting"], () =>
    dependsOn(scene.state.served, siteOptions(scene.state)),
  );
  scene.on(["search", "served"], () => run.forgive());
  scene.on(["plan"], () => {
    const { plan, served } = scene.state;
    if (plan) run.show(plan.job, dependsOn(served, plan.job.options));
    showPlan(scene);
  });
  run.complain(gone);
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
function servedNow({ result: { asked, points } }, sources) {
  const serves = (/** @type {number} */ verdict) => verdict === VISIBLE;
  if (points) return countServed(points, sources, serves);
  return asked.unit === "ground" ? tally(sources, serves).any : null;
}

/** @param {number} change @param {number} before @param {Plan["result"]} result */
function changeText(change, before, result) {
  if (change === 0) return "as much as";
  return `${amountText(Math.abs(change), result)} (${shareText(Math.abs(change), before)}) ${change < 0 ? "less" : "more"} than`;
}
