// The key that the server printed with its address. It moves from the address, which people share, into the browser's
// store for this origin, so that a reload or a bookmark works while that server runs.

const NAME = "itin-key";

/** Starts the page anew with the key of another start of the server: from an address that is opened in this tab, or from
 * another tab. What is on the map stays. @param {() => string} sceneText  The address of the scene. */
export function followNewKeys(sceneText) {
  addEventListener("hashchange", () => {
    const fields = new URLSearchParams(location.hash.slice(1));
    if (!fields.has("key")) return;
    if (fields.size === 1) history.replaceState(null, "", `#${fields}&${sceneText()}`);
    location.reload();
  });
  addEventListener("storage", ({ key }) => key === NAME && location.reload());
}

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
