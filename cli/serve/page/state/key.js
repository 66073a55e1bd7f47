// The key that the server printed with its address. It moves from the address, which people share, into the browser's
// store for this origin, so that a reload or a bookmark works while that server runs.

const NAME = "itin-key";

/** Takes the key out of the address. @returns {{key: string, rest: string}} the key, and the address without it */
export function takeKey() {
  const fields = new URLSearchParams(location.hash.slice(1));
  const given = fields.get("key");
  if (given) localStorage.setItem(NAME, given);
  fields.delete("key");
  const rest = fields.toString();
  history.replaceState(null, "", rest ? `#${rest}` : location.pathname);
  return { key: given ?? localStorage.getItem(NAME) ?? "", rest };
}
