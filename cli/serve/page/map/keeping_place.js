// What stands on the map stays where it is on the screen while a panel below opens or closes.

const MARGIN_PIXELS = 24;

/** Lets the map change its height without moving what it shows, but where that would hide a place.
 * @param {import("../vendor/ol.js").OlMap} map @param {{x: number, y: number} | null} end
 * @param {() => void} change */
export function keepingPlace(map, end, change) {
  const before = map.getSize()?.[1] ?? 0;
  const view = map.getView();
  change();
  map.updateSize();
  const height = map.getSize()?.[1] ?? before;
  const centre = view.getCenter();
  const resolution = view.getResolution();
  if (height === before || !centre || !resolution) return;
  const north = centre[1] + ((before - height) / 2) * resolution;
  const lowest = north - (height / 2 - MARGIN_PIXELS) * resolution;
  view.setCenter([centre[0], end && end.y < lowest ? north - (lowest - end.y) : north]);
}
