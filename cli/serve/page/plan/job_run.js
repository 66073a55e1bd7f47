// A call of the program that the planner starts: how far it is, what is wrong with it, and the files that it wrote.

import { make } from "../panel/elements.js";
import { UPLOADED } from "../server/api.js";
import { inPageWords, problemText } from "../panel/page_words.js";
import { numberText } from "../panel/words.js";

/** @typedef {import("../server/api.js").Jobs} Jobs */
/** @typedef {import("../server/api.js").Job} Job */
/** @typedef {{verb: string, options: import("../server/api.js").Options, uploads: string[]}} Call
 *    `uploads` are files that only this call reads. */

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../state/scene.js").SceneState} SceneState */

export class JobRun {
  #now = make("div", "run-now");
  #bar = make("progress");
  #stage = make("span", "quiet");
  #problem = make("p", "problem");
  #outdated = make("p", "problem", "Out of date: what was asked has changed since.");
  #warnings = make("p", "quiet run-warnings");
  #files = make("ul", "run-files");
  #given = new AbortController();
  /** What would be asked now, and what was asked for the result that is shown; null where there is none. */
  #asks = () => "";
  /** @type {string | null} */
  #asked = null;
  /** The call whose result is shown. @type {Job | null} */
  #shown = null;

  /** @param {HTMLElement} box @param {Jobs} jobs @param {string} what  What is being done, for those who hear it.
   * @param {(name: string) => boolean} [listed]  Which of the files are listed.
   * @param {Map<string, string>} [names]  What options are called that have fields of their own. */
  constructor(box, jobs, what, listed = () => true, names = new Map()) {
    this.jobs = jobs;
    this.listed = listed;
    this.names = names;
    const cancel = make("button", "", "Cancel");
    cancel.type = "button";
    cancel.addEventListener("click", () => this.cancel());
    this.#bar.max = 1;
    this.#bar.ariaLabel = what;
    this.#problem.setAttribute("role", "alert");
    this.#now.append(this.#bar, this.#stage, cancel);
    this.#files.tabIndex = 0;
    this.#files.ariaLabel = "Files";
    box.classList.add("run");
    this.#outdated.setAttribute("role", "status");
    box.append(this.#now, this.#problem, this.#outdated, this.#warnings, this.#files);
    this.compare();
    this.#running(false);
    this.#files.hidden = true;
  }

  get running() {
    return !this.#now.hidden;
  }

  cancel() {
    this.#given.abort();
  }

  /** Says of a result that it is out of date, as soon as something else would be asked. @param {Scene} scene
   * @param {(keyof SceneState)[]} keys @param {() => unknown} asks  What would be asked now. */
  follow(scene, keys, asks) {
    this.#asks = () => JSON.stringify(asks());
    scene.on(keys, () => this.compare());
  }

  compare() {
    this.#outdated.hidden = this.#asked === null || this.#asked === this.#asks();
  }

  /** @param {string} problem */
  complain(problem) {
    this.#problem.textContent = problem;
  }

  /** Takes back what went wrong, once what was asked has changed. */
  forgive() {
    this.#problem.textContent = "";
  }

  /** Runs a call, in place of one that runs already. @param {() => Promise<Call>} prepare
   * @returns {Promise<Job | null>} null where it failed, as the page then says, or was given up */
  async run(prepare) {
    this.cancel();
    const given = new AbortController();
    this.#given = given;
    this.#problem.textContent = "";
    this.#warnings.textContent = "";
    this.#files.hidden = true;
    this.#asked = this.#shown = null;
    this.compare();
    const asked = this.#asks();
    this.#look({ share: 0, stage: "waiting", seconds_left: null });
    this.#running(true);
    let job = null;
    try {
      job = await this.#ended(await prepare(), given.signal);
    } catch (problem) {
      if (!given.signal.aborted) {
        this.#problem.textContent = problemText(problem, this.names).replace(UPLOADED, "the table sent");
      }
    }
    if (this.#given === given) this.#running(false);
    if (given.signal.aborted || !job) return null;
    this.#tell(job, asked);
    return job;
  }

  /** Shows the result of a call that was made before, unless that is shown. @param {Job} job
   * @param {unknown} asked  What was asked. */
  show(job, asked) {
    if (job.id !== this.#shown?.id) this.#tell(job, JSON.stringify(asked));
  }

  /** @param {Job} job @param {string} asked */
  #tell(job, asked) {
    this.#asked = asked;
    this.#shown = job;
    this.compare();
    this.#warn(job);
    this.#list(job);
  }

  /** @param {Call} call @param {AbortSignal} signal */
  async #ended({ verb, options, uploads }, signal) {
    try {
      const url = await this.jobs.start(verb, options);
      return await this.jobs.ended(url, (job) => !signal.aborted && this.#look(job), signal);
    } finally {
      for (const name of uploads) this.jobs.forget(name).catch(() => {});
    }
  }

  /** @param {boolean} running */
  #running(running) {
    this.#now.hidden = !running;
  }

  /** @param {Pick<Job, "share" | "stage" | "seconds_left">} job */
  #look({ share, stage, seconds_left }) {
    this.#bar.value = share ?? 0;
    const left = seconds_left ? `, ${numberText(Math.ceil(seconds_left))} s left` : "";
    this.#stage.textContent = `${stage ?? "starting"}${left}`;
  }

  /** Says what the program warns of. @param {Job} job */
  #warn({ document }) {
    this.#warnings.textContent = (document?.warnings ?? [])
      .map((/** @type {string} */ warning) => inPageWords(warning, this.names))
      .map((/** @type {string} */ text) => `${text.slice(0, 1).toUpperCase()}${text.slice(1)}.`)
      .join(" ")
      .replace(UPLOADED, "the table sent");
  }

  /** Lists the files, a report first. @param {Job} job */
  #list({ files, document }) {
    const what = new Map((document?.outputs ?? []).map((/** @type {any} */ output) => [output.path, output.what]));
    const order = (/** @type {{name: string}} */ { name }) =>
      name.endsWith(".html") ? 0 : /\.(pdf|png|csv)$/.test(name) ? 1 : what.has(name) ? 2 : 3;
    const items = files
      .filter(({ name }) => this.listed(name))
      .sort((a, b) => order(a) - order(b))
      .map(({ name, url }) => {
        const item = make("li");
        const link = make("a", "", name.split("/").slice(1).join("/") || name);
        link.href = url;
        link.download = name.split("/").at(-1) ?? name;
        const [first] = String(what.get(name) ?? "").split(";");
        item.append(link, make("span", "quiet", first && ` ${first}`));
        return item;
      });
    this.#files.replaceChildren(...items);
    this.#files.hidden = items.length === 0;
  }
}
