// What a page that opens asks the server for again: files and a choice of sites that its address names.

import { askJob, askUpload } from "../server/api.js";
import { readChoice } from "../state/address.js";
import { placesServed, servedOf } from "../state/served.js";
import { planOf } from "./site_choice.js";

/** @typedef {import("../state/scene.js").SceneState} SceneState */
/** @typedef {{search: string, served: string, plan: string}} Gone  Says what is not there any more; else empty. */

/** @param {string} file */
const goneText = (file) =>
  `${file} is gone: the server keeps the last 16 files that it was sent, until it ends. Load it again.`;
const NO_CHOICE =
  "The choice of sites is gone: the server keeps its last 16 results, until it ends. Choose sites again.";

/** @param {SceneState} state @returns {Promise<[Partial<SceneState>, string]>} */
async function recalledSearch({ search }) {
  if (!search || !("upload" in search)) return [{}, ""];
  const upload = await askUpload(search.upload);
  if (!upload) return [{ search: null }, goneText(search.file)];
  return [{ search: { ...search, places: upload.places, rings: upload.rings } }, ""];
}

/** @param {SceneState} state @returns {Promise<[Partial<SceneState>, string]>} */
async function recalledServed({ served }) {
  if (served.kind !== "places" || !served.upload) return [{}, ""];
  const upload = await askUpload(served.upload);
  if (!upload) return [{ served: servedOf("places") }, goneText(served.file)];
  return [{ served: placesServed(served.file, upload) }, ""];
}

/** @param {string} address @param {SceneState} state @returns {Promise<[Partial<SceneState>, string]>} */
async function recalledPlan(address, { served }) {
  const choice = readChoice(address);
  if (!choice) return [{}, ""];
  const job = await askJob(choice.job);
  if (job?.document?.command?.verb !== "site") return [{}, NO_CHOICE];
  const plan = await planOf(job, served);
  for (const { site, x, y } of choice.moved) if (plan.sites[site]) Object.assign(plan.sites[site], { x, y });
  return [{ plan }, ""];
}

/** Completes what the address says. @param {string} address @param {SceneState} state
 * @returns {Promise<{state: SceneState, gone: Gone}>} */
export async function recall(address, state) {
  const [[search, noSearch], [served, noServed], [plan, noPlan]] = await Promise.all([
    recalledSearch(state),
    recalledServed(state),
    recalledPlan(address, state),
  ]);
  return {
    state: { ...state, ...search, ...served, ...plan },
    gone: { search: noSearch, served: noServed, plan: noPlan },
  };
}
