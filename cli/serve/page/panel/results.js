// What the planner takes along: the command that writes the same bytes, and files that this command writes, made by the
// server in a process of its own.

import { element } from "./elements.js";
import { problemText } from "./page_words.js";
import { observerOf, optionsOf } from "../seen/viewers.js";

/** @typedef {import("../state/scene.js").Scene} Scene */
/** @typedef {import("../state/scene.js").Mast} Mast */
/** @typedef {import("../seen/live_views.js").LiveViews} LiveViews */
/** @typedef {import("../server/api.js").Jobs} Jobs */

/** The option that writes a file of this ending. @type {Record<string, string>} */
const OUTPUTS = { tif: "output", gpkg: "output", png: "image", pdf: "sheet" };

/**
 * Together they are one call with all observers; else the mast selected is meant.
 * @param {Scene} scene
 * @returns {Mast[]}
 */
function mastsMeant(scene) {
  if (scene.state.show === "together") return scene.state.masts;
  return scene.mast ? [scene.mast] : [];
}

/** A word for the shell. @param {string} text */
const quoted = (text) => (/^[\w.:+-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`);

/**
 * The command of one mast, which the server has told, with the observers of all.
 * @param {Scene} scene
 * @param {LiveViews} views
 */
export function commandOf(scene, views) {
  const masts = mastsMeant(scene);
  const command = masts[0] && views.of(masts[0].id)?.done?.command;
  return command
    ? command.replace(
        /--observer=\S+/,
        masts.map((mast) => `--observer=${observerOf(mast)} --observer-name=${quoted(mast.name)}`).join(" "),
      )
    : "";
}

/** A name for files, of letters and figures. @param {Mast[]} masts */
const fileName = (masts) =>
  (masts.length === 1 ? masts[0].name : "masts")
    .toLowerCase()
    .replace(/[^a-z0-9]+/g, "-")
    .replace(/^-+|-+$/g, "") || "mast";

/** @param {Scene} scene @param {LiveViews} views @param {Jobs} jobs */
export function makeResults(scene, views, jobs) {
  const copy = /** @type {HTMLButtonElement} */ (element("copy"));
  const said = element("results-said");
  const command = element("command");
  const section = element("results");
  copy.addEventListener("click", async () => {
    try {
      await navigator.clipboard.writeText(commandOf(scene, views));
      said.textContent = "Copied.";
    } catch {
      // some browsers only let pages of this machine copy
      getSelection()?.selectAllChildren(command);
      said.textContent = "The command is selected: copy it with Ctrl+C.";
    }
  });
  const buttons = /** @type {NodeListOf<HTMLButtonElement>} */ (section.querySelectorAll("button[data-ending]"));
  const download = new Download(jobs, (busy) => buttons.forEach((button) => (button.disabled = busy)));
  for (const button of buttons) {
    button.addEventListener("click", () => {
      const masts = mastsMeant(scene);
      const ending = button.getAttribute("data-ending") ?? "tif";
      download.start({
        ...optionsOf(scene.state),
        observer: masts.map(observerOf),
        "observer-name": masts.map(({ name }) => name),
        [OUTPUTS[ending]]: `${fileName(masts)}.${ending}`,
      });
    });
  }
  const show = () => {
    const masts = mastsMeant(scene);
    section.hidden = scene.state.masts.length === 0;
    command.textContent = commandOf(scene, views);
    copy.disabled = command.textContent === "";
    element("results-of").textContent = masts.length === 1 ? masts[0].name : "what any of the masts sees";
  };
  views.onChange(show);
  scene.on(["masts", "selected", "show"], show);
}

/** One file that is being made; meanwhile no other one can be asked for. */
class Download {
  #box = element("job");
  #bar = /** @type {HTMLProgressElement} */ (element("job-bar"));
  #said = element("results-said");
  #given = new AbortController();

  /** @param {Jobs} jobs @param {(busy: boolean) => void} onBusy */
  constructor(jobs, onBusy) {
    this.jobs = jobs;
    this.onBusy = onBusy;
    element("job-cancel").addEventListener("click", () => this.#given.abort());
  }

  /** @param {import("../server/api.js").Options} options */
  async start(options) {
    this.#said.textContent = "";
    this.#show(true);
    this.#given = new AbortController();
    try {
      const url = await this.jobs.start("viewshed", options);
      const job = await this.jobs.ended(url, (now) => this.#look(now), this.#given.signal);
      if (job) this.#save(job.files);
    } catch (problem) {
      this.#said.textContent = problemText(problem);
    }
    this.#show(false);
  }

  /** @param {boolean} busy */
  #show(busy) {
    this.#box.hidden = !busy;
    this.onBusy(busy);
  }

  /** @param {import("../server/api.js").Job} job */
  #look({ share, stage }) {
    this.#bar.value = share ?? 0;
    this.#bar.title = stage ?? "";
  }

  /** @param {{name: string, url: string}[]} files */
  #save(files) {
    for (const { name, url } of files) {
      const link = document.createElement("a");
      link.href = url;
      link.download = name;
      link.click();
    }
    this.#said.textContent = `Saved ${files.map(({ name }) => name).join(", ")}.`;
  }
}
