// The page's own elements, by the ids of index.html.

/** @param {string} id @returns {HTMLElement} */
export function element(id) {
  const found = document.getElementById(id);
  if (!found) throw new Error(`index.html has no element "${id}"`);
  return found;
}

/** Makes an element with a class and text. @template {keyof HTMLElementTagNameMap} Tag @param {Tag} tag
 * @param {string} [className] @param {string} [text] @returns {HTMLElementTagNameMap[Tag]} */
export function make(tag, className = "", text = "") {
  const made = document.createElement(tag);
  if (className) made.className = className;
  if (text) made.textContent = text;
  return made;
}
