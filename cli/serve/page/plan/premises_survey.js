// Which buildings the masts serve, and the files that tell of each.

import { element } from "../panel/elements.js";
import { countedText, numberText, shareText } from "../panel/words.js";
import { jobOptions } from "./job_options.js";
import { JobRun } from "./job_run.js";
import { buildingsOf } from "../state/premises.js";
import { mastRows, mastTable, rowsIn } from "./tables.js";

/** @typedef {import("../state/scene.js").Scene} Scene */

/** @param {Scene} scene @param {import("../server/api.js").Jobs} jobs */
export function makePremisesSurvey(scene, jobs) {
  const button = /** @type {HTMLButtonElement} */ (element("survey-premises"));
  const sum = element("premises-sum");
  const run = new JobRun(element("premises-run"), jobs, "Surveying the buildings");
  button.addEventListener("click", async () => {
    sum.textContent = "";
    scene.change({ premises: null });
    const job = await run.run(async () => {
      const { name } = await jobs.send("masts.csv", mastTable(scene.state.masts));
      const options = { ...jobOptions("premises", scene.state.options), masts: name, output: "premises" };
      return { verb: "premises", options, uploads: [name] };
    });
    if (!job) return;
    sum.textContent = sumText(job.document.premises);
    const table = job.files.find(({ name }) => name.endsWith("premises.csv"));
    if (table) scene.change({ premises: buildingsOf(rowsIn(await (await fetch(table.url)).text())) });
  });
  run.follow(scene, ["masts", "options"], () => [
    mastRows(scene.state.masts),
    jobOptions("premises", scene.state.options),
  ]);
  scene.on(["masts"], () => (button.disabled = scene.state.masts.length === 0));
}

/** @param {Record<string, number>} counts */
function sumText({ all, served, on_walls, on_roofs, unserved, undecided, out_of_reach }) {
  const parts = [
    `${numberText(served)} of ${countedText(all, "building")} served (${shareText(served, all)})`,
    `${numberText(on_walls)} on a wall`,
    `${numberText(on_roofs)} on the roof alone`,
    `${numberText(unserved)} not`,
  ];
  if (undecided > 0) parts.push(`${numberText(undecided)} undecided`);
  if (out_of_reach > 0) parts.push(`${numberText(out_of_reach)} out of reach`);
  return `${parts.join(", ")}.`;
}
