// Fields count while one types, as soon as the typing rests, and at once when they are left.

const REST = 400;

/** @param {HTMLElement} field  A field, or what holds fields.
 * @param {(field: EventTarget | null, left: boolean) => void} take  Gets the field, and whether it is left. */
export function onTyped(field, take) {
  let resting = 0;
  field.addEventListener("input", ({ target }) => {
    clearTimeout(resting);
    resting = setTimeout(() => take(target, false), REST);
  });
  field.addEventListener("change", ({ target }) => {
    clearTimeout(resting);
    take(target, true);
  });
}
