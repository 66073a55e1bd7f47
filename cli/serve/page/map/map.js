// The map itself, in the store's own CRS: the server reprojects nothing, and neither does the page.

import { OlMap, Projection, ScaleLine, View, defaultControls, defaultInteractions } from "../vendor/ol.js";

/** @typedef {import("../server/api.js").Info} Info */
/** @typedef {import("../state/scene.js").Scene} Scene */

/** @param {Info} info */
export const projectionOf = (info) => new Projection({ code: "itin:store", units: "m", extent: extentOf(info) });

/** @param {Info} info */
const extentOf = ({ bounds: { xmin, ymin, xmax, ymax } }) => [xmin, ymin, xmax, ymax];

/** @param {HTMLElement} element @param {Info} info @param {Scene} scene */
export function makeMap(element, info, scene) {
  const [west, south, east, north] = extentOf(info);
  const finest = info.tiles.resolutions.at(-1) ?? 1;
  const margin = 0.5 * Math.max(east - west, north - south);
  const { view } = scene.state;
  const map = new OlMap({
    target: element,
    controls: defaultControls({ attribution: false, rotate: false }).extend([new ScaleLine({ minWidth: 90 })]),
    interactions: defaultInteractions({ altShiftDragRotate: false, pinchRotate: false, doubleClickZoom: false }),
    view: new View({
      projection: projectionOf(info),
      center: view ? [view.x, view.y] : [(west + east) / 2, (south + north) / 2],
      resolution: view?.resolution ?? 100,
      extent: [west - margin, south - margin, east + margin, north + margin],
      minResolution: finest / 64,
      maxResolution: (4 * margin) / 256,
      enableRotation: false,
      showFullExtent: true,
    }),
  });
  if (!view) showWhole(map, info);
  map.on("moveend", () => keepView(map, scene));
  return map;
}

/** Shows all that the store holds. @param {OlMap} map @param {Info} info */
export function showWhole(map, info) {
  map.getView().fit(extentOf(info), { padding: [24, 24, 24, 24] });
}

/** @param {OlMap} map @param {Scene} scene */
function keepView(map, scene) {
  const centre = map.getView().getCenter();
  const resolution = map.getView().getResolution();
  if (!centre || !resolution) return;
  const round = (/** @type {number} */ n) => Number(n.toPrecision(8));
  scene.change({ view: { x: round(centre[0]), y: round(centre[1]), resolution: round(resolution) } });
}
