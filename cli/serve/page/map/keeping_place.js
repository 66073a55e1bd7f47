// What stands on the map stays where it is on the screen while a panel below opens or closes.

/** Room for a marker above the scale. */
const MARGIN_PIXELS = 56;

/** The middle of the map after a place was brought into view, and how far north that is of where it would have been. */
let raised = { north: NaN, by: 0 };

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
  // Where the planner has not moved the map meanwhile, it goes back to where it was.
  const still = Math.abs(centre[1] - raised.north) < resolution;
  const north = centre[1] + ((before - height) / 2) * resolution + (height > before && still ? raised.by : 0);
  const lowest = north - (height / 2 - MARGIN_PIXELS) * resolution;
  const by = end && end.y < lowest ? lowest - end.y : 0;
  raised = { north: north - by, by };
  view.setCenter([centre[0], north - by]);
}
