// Outlines of a theme's features, from the server's tiles of rings.

import { PathLayer } from "./path_layer.js";
import { tileGridOf } from "./relief_layer.js";

/** @typedef {import("../server/api.js").Info} Info */

/** @type {Record<string, {fill: string, line: string}>} */
const COLOURS = {
  buildings: { fill: "rgb(120 72 60 / 0.55)", line: "rgb(92 50 40)" },
  vegetation: { fill: "rgb(70 120 60 / 0.4)", line: "rgb(50 92 44)" },
  water: { fill: "rgb(90 150 200 / 0.5)", line: "rgb(50 100 150)" },
};
const OTHER = { fill: "rgb(110 100 120 / 0.35)", line: "rgb(80 72 90)" };

export class ThemeLayer extends PathLayer {
  /** @param {Info} info @param {string} name */
  constructor(info, name) {
    super(tileGridOf(info));
    this.name = name;
    this.address = (/** @type {number[]} */ tile) =>
      `/tiles/theme/${encodeURIComponent(name)}/${tile.join("/")}?v=${encodeURIComponent(info.version)}`;
    this.colours = COLOURS[info.themes.find((theme) => theme.name === name)?.kind ?? ""] ?? OTHER;
  }

  /** @param {number[]} tile */
  async load(tile) {
    const answer = await fetch(this.address(tile));
    const { rings } = answer.status === 200 ? await answer.json() : { rings: [] };
    const [west, , , north] = this.grid.getTileCoordExtent(tile);
    return [{ path: pathOf(rings, west, north), ...this.colours, width: 1 }];
  }
}

/** @param {number[][]} rings @param {number} west @param {number} north */
function pathOf(rings, west, north) {
  const path = new Path2D();
  for (const ring of rings) {
    path.moveTo(ring[0] - west, north - ring[1]);
    for (let i = 2; i + 1 < ring.length; i += 2) path.lineTo(ring[i] - west, north - ring[i + 1]);
    path.closePath();
  }
  return path;
}

/** Adds a layer for each theme to the map, and shows those that are to be drawn.
 * @param {import("../vendor/ol.js").OlMap} map @param {Info} info @param {import("../state/scene.js").Scene} scene */
export function drawThemes(map, info, scene) {
  const layers = info.tiles.themes.map((name) => new ThemeLayer(info, name));
  layers.forEach((layer) => map.addLayer(layer));
  scene.on(["layers"], () =>
    layers.forEach((layer) => layer.setVisible(scene.state.layers.themes.includes(layer.name))),
  );
}
