// What stands on a mast's marker: what tells it from others in a name such as "Mast B" or "Site 12", else its first
// letter.

/** @param {{name: string}} mast */
export function letterOf({ name }) {
  const words = name.trim().split(/\s+/);
  const last = words.at(-1) ?? "";
  return words.length > 1 && last.length <= 2 ? last : name.trim().slice(0, 1).toUpperCase();
}
