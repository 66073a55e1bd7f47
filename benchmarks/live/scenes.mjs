// The stores and masts of the figures, which are those of benchmarks/viewshed/live_map.cpp.
import { existsSync, mkdirSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

import { itin } from "../../tests/live/served_map.mjs";

const root = fileURLToPath(new URL("../../", import.meta.url));
const data = process.env.ITIN_DATA_DIR ?? join(root, "../shared/data");
export const work = join(root, "build/live-figures");

const cardiff = join(root, "scripts/demo-data/cardiff.tif");
const wales = join(data, "os-terrain50-wales/tiles");
const lidar = ["ign_0299_6802.las", "ign_0300_6802.las"].map((name) => join(data, "derived-las", name));

/** Tiles of the National Grid about the masts in Wales, 100 km square by square. */
const isSeen = (/** @type {string} */ name) => /^(sh|sn|so|sj)\d\d/i.test(name);

/** How each store is made; nothing where its source is not there. @type {Record<string, () => string[] | null>} */
const SOURCES = {
  cardiff: () => [cardiff],
  wales: () =>
    existsSync(wales)
      ? readdirSync(wales)
          .filter((name) => name.endsWith(".zip") && isSeen(name))
          .map((name) => join(wales, name))
      : null,
  lidar: () => (lidar.every((path) => existsSync(path)) ? lidar : null),
  town: () => [cardiff],
};

/** 2,468 houses in streets, as GeoJSON. */
function houses() {
  const shape = [
    [0, 0],
    [12, 3],
    [10, 11],
    [-2, 8],
    [0, 0],
  ];
  const features = Array.from({ length: 2468 }, (_, i) => {
    const [west, south] = [318000 + (i % 50) * 40, 188000 + Math.floor(i / 50) * 40];
    const ring = shape.map(([x, y]) => [west + x, south + y]);
    return { type: "Feature", properties: { HEIGHT: 5 + (i % 7) }, geometry: { type: "Polygon", coordinates: [ring] } };
  });
  const crs = { type: "name", properties: { name: "EPSG:27700" } };
  return JSON.stringify({ type: "FeatureCollection", crs, features });
}

/** The path of a store, made where it is not there yet; null where it cannot be made. @param {string} name */
export function storeOf(name) {
  mkdirSync(work, { recursive: true });
  const path = join(work, `${name}.itin`);
  if (existsSync(path)) return path;
  const sources = SOURCES[name]?.();
  if (!sources) return null;
  console.error(`makes ${path}, once`);
  itin(["import", path, ...sources, "--quiet"], work);
  if (name === "town") {
    writeFileSync(join(work, "houses.geojson"), houses());
    itin(["import", path, "houses.geojson", "--kind", "buildings", "--height-field", "HEIGHT", "--quiet"], work);
  }
  return path;
}

/**
 * @typedef {object} Scene
 * @property {string} name @property {string} store @property {number} x @property {number} y
 * @property {number} radius @property {number} cell
 * @property {Aims} aims  Milliseconds that 95 % are to meet.
 */
/** @typedef {{first: number, ninth: number, all: number, answer: number, painted?: number}} Aims */

/** @type {Scene[]} */
export const SCENES = [
  {
    ...{ name: "Cardiff, 10 km, 126,000", store: "cardiff", x: 319000, y: 189000, radius: 10000, cell: 50 },
    aims: { first: 33, ninth: 40, all: 100, answer: 300, painted: 90 },
  },
  {
    ...{ name: "Wales, 10 km, 1.0 million", store: "wales", x: 275000, y: 260000, radius: 10000, cell: 17.5 },
    aims: { first: 33, ninth: 40, all: 300, answer: 300, painted: 90 },
  },
  {
    ...{ name: "Wales, 40 km, 1.0 million", store: "wales", x: 275000, y: 260000, radius: 40000, cell: 70 },
    aims: { first: 60, ninth: 100, all: 400, answer: 1000 },
  },
  {
    ...{ name: "Wales, 40 km, from a summit", store: "wales", x: 278970, y: 286940, radius: 40000, cell: 70 },
    aims: { first: 60, ninth: 100, all: 400, answer: 1000 },
  },
  {
    ...{ name: "2,468 houses, 126,000", store: "town", x: 319010, y: 189010, radius: 1000, cell: 5 },
    aims: { first: 33, ninth: 40, all: 100, answer: 300, painted: 90 },
  },
  {
    ...{ name: "lidar, 1.0 million", store: "lidar", x: 300000, y: 6801500, radius: 500, cell: 0.875 },
    aims: { first: 33, ninth: 40, all: 600, answer: 300, painted: 90 },
  },
];
