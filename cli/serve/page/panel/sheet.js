// On a phone the column is a sheet that comes from below: a button opens and closes it.

import { element } from "./elements.js";

export function makeSheet() {
  const button = element("sheet-button");
  const column = element("column");
  button.addEventListener("click", () => {
    const open = column.classList.toggle("open");
    button.setAttribute("aria-expanded", String(open));
  });
}
