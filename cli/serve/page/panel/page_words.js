// The program's messages in the words of the page: what the command line calls options are fields here.

import { element } from "./elements.js";

/** What the field of each option is called on the page. @returns {Map<string, string>} */
function namesOfFields() {
  const fields = /** @type {NodeListOf<HTMLInputElement>} */ (element("options").querySelectorAll("[name]"));
  return new Map(
    [...fields].map(({ name, labels }) => {
      const label = labels?.[0]?.querySelector("span")?.textContent ?? name;
      return [name, label.replace(/^or /, "")];
    }),
  );
}

/** @param {string} message */
export function inPageWords(message) {
  const names = namesOfFields();
  return message
    .replace(/^--(to|from|observer) '[^']*': /, "this place ")
    .replace(/--([a-z][a-z-]*[a-z])/g, (option, name) => (names.has(name) ? `“${names.get(name)}”` : option));
}
