// What dwellings near by see of the turbines, when shadows flicker there, and the files that tell of each.

import { element } from "../panel/elements.js";
import { countedText, numberText } from "../panel/words.js";
import { jobOptions } from "./job_options.js";
import { JobRun } from "./job_run.js";
import { turbineTable } from "./tables.js";
import { hasBuildings } from "./tasks_form.js";

/** @typedef {import("../state/scene.js").Scene} Scene */

const field = (/** @type {string} */ id) => /** @type {HTMLInputElement} */ (element(id));

/** The options of `itin dwellings` that have fields of their own here. */
const FIELDS = /** @type {const} */ ([
  ["dwelling-radius", "radius"],
  ["flicker-year", "year"],
  ["flicker-clock", "time-zone"],
]);

/** What fields of these options are called here, for messages. */
const namesOfFields = () =>
  new Map(FIELDS.map(([id, option]) => [option, `“${field(id).labels?.[0].querySelector("span")?.textContent}”`]));

/** @param {Scene} scene @param {import("../server/api.js").Jobs} jobs @param {import("../server/api.js").Info} info */
export function makeDwellingsSurvey(scene, jobs, info) {
  element("dwellings").hidden = !hasBuildings(info);
  const button = /** @type {HTMLButtonElement} */ (element("survey-dwellings"));
  const sum = element("dwellings-sum");
  field("flicker-year").value = String(new Date().getFullYear());
  const run = new JobRun(element("dwellings-run"), jobs, "Surveying the dwellings", () => true, namesOfFields());
  button.addEventListener("click", async () => {
    sum.textContent = "";
    const job = await run.run(async () => {
      const { name } = await jobs.send("turbines.csv", turbineTable(scene.state.turbines));
      const own = FIELDS.map(([id, option]) => [option, field(id).value.trim()]).filter(([, value]) => value !== "");
      const options = {
        ...jobOptions("dwellings", scene.state.options),
        ...Object.fromEntries(own),
        ...(field("dwelling-sheets").checked ? { sheets: "A3" } : {}),
        ...{ turbines: name, output: "dwellings" },
      };
      return { verb: "dwellings", options, uploads: [name] };
    });
    if (job) sum.textContent = sumText(job.document);
  });
  run.follow(scene, ["turbines", "options"], () => [
    scene.state.turbines,
    jobOptions("dwellings", scene.state.options),
    ...FIELDS.map(([id]) => field(id).value),
    field("dwelling-sheets").checked,
  ]);
  element("dwellings").addEventListener("change", () => run.compare());
  scene.on(["turbines"], () => (button.disabled = scene.state.turbines.length === 0));
}

/** @param {any} document  Of `itin dwellings`. */
function sumText({ dwellings: { all, see_a_tip, see_a_tip_screened, with_flicker, over_year, over_day }, flicker }) {
  const past = see_a_tip_screened === null ? "" : `, ${numberText(see_a_tip_screened)} past what stands on it`;
  return (
    `${countedText(all, "dwelling")}: ${numberText(see_a_tip)} see a blade tip over the bare ground${past}. ` +
    `Shadows flicker at ${numberText(with_flicker)} in the worst case of ${flicker.year}: ` +
    `at ${numberText(over_year)} for more than ${numberText(flicker.limit_hours_year)} hours, ` +
    `at ${numberText(over_day)} for more than ${numberText(flicker.limit_minutes_day)} minutes on a day.`
  );
}
