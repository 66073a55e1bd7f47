// The program's messages in the words of the page: what the command line calls options are fields here, or what is done
// when a store is imported or the server is started.

import { messageOf } from "./words.js";

const SEA = "import the store anew with the elevation of the sea, which fills such ground";
const DEGREES = "type degrees with their letters, such as 51.54N 3.29W";

/** What the command line would do, and what is done in the page instead. The first that fits comes first.
 * @type {[RegExp, string][]} */
const ADVICE = [
  [/^--(to|from|observer) '[^']*': (?=a height)/, ""],
  [/^--(to|from|observer) '[^']*': /, "this place "],
  [/; for an elevation give --absolute-heights/g, ""],
  [/, or what stands for missing heights/g, ""],
  [/ --nodata says what it does to sight lines that cross it; import a larger/g, " To know more, import a larger"],
  [/import with --sea-level, and beyond the sources with --sea-area/g, SEA],
  [/import with --sea-level/g, SEA],
  [/it is in degrees: give --in-crs \S+, too/g, `it is in degrees: ${DEGREES}`],
  [/give \S+ and --in-crs \S+, or '[^']*'/g, DEGREES],
  [/, or say by --in-crs what its coordinates are/g, ""],
  [/to stand on top give --observer-on surface/g, "to stand on top let masts stand on roofs and tops"],
  [/let it stand on that by --observer-on surface/g, "let masts stand on roofs and tops"],
  [/import them again with --height-field or --height/g, "import them again with their heights"],
  [/import with --attributes to keep fields/g, "import the store anew, so that it keeps their fields"],
  [/import some with --kind buildings/g, "import some"],
  [/(give )?more --memory( than \S+)?/g, "more memory for the server when it is started"],
  [/--nodata block or clear decides/g, "“Ground without data” decides"],
];

/** What the page calls options that are no fields of its own. @type {Record<string, string>} */
const NAMES = {
  masts: "the masts",
  turbines: "the turbines",
  candidates: "the candidates",
  "search-area": "the area where masts may stand",
  memory: "the server’s memory",
  tolerance: "the tolerance",
  from: "the mast",
  to: "the target",
  observer: "the mast",
  observers: "the masts",
};

/** @typedef {HTMLElement & {labels?: NodeListOf<HTMLLabelElement> | null}} Field */

/** What the field of each option is called on the page: options of the map by their names, those of what is planned by
 * `data-option`. @returns {Map<string, string>} */
function namesOfFields() {
  const fields = /** @type {NodeListOf<Field>} */ (document.querySelectorAll("#options [name], [data-option]"));
  return new Map(
    [...fields].map((field) => {
      const option = field.dataset.option ?? field.getAttribute("name") ?? "";
      const label = field.labels?.[0]?.querySelector("span")?.textContent ?? field.ariaLabel ?? option;
      return [option, `“${label.replace(/^or /, "")}”`];
    }),
  );
}

/** @param {string} message @param {Map<string, string>} [own]  What options are called where the message is about
 *   fields of their own. */
export function inPageWords(message, own = new Map()) {
  const fields = namesOfFields();
  const advised = ADVICE.reduce((text, [found, words]) => text.replace(found, words), message);
  return advised.replace(
    /--([a-z][a-z0-9-]*[a-z0-9])/g,
    (_, name) => own.get(name) ?? fields.get(name) ?? NAMES[name] ?? `“${name.replaceAll("-", " ")}”`,
  );
}

/** What went wrong, as the page says it. @param {unknown} problem @param {Map<string, string>} [own] */
export const problemText = (problem, own) => inPageWords(messageOf(problem), own);
