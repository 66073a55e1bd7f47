// The page's modules that need no browser: what they read, keep, count and paint, beside slow and obvious twins.
// scripts/web-packages lays out what this imports.
import assert from "node:assert/strict";
import test from "node:test";

const module = (name) => import(new URL(`../../build/web/page/${name}.js`, import.meta.url));

globalThis.ImageData = class {
  constructor(width, height) {
    Object.assign(this, { width, height, data: new Uint8ClampedArray(4 * width * height) });
  }
};

const { readTiles } = await module("server/tile_message");
const { SeenCells, NEAREST, OUTSIDE, UNKNOWN } = await module("seen/seen_cells");
const { verdictPicture, valuePicture } = await module("seen/picture");
const { paintMosaic } = await module("seen/mosaic");
const { tally } = await module("seen/tally");
const { HUES } = await module("seen/palette");
const { VALUE_MODES, classOf, className } = await module("seen/values");
const { addressOf, readAddress } = await module("state/address");
const { letterOf } = await module("state/mast_letter");
const { Scene } = await module("state/scene");
const { firstState } = await module("state/first_state");
const { relief } = await module("map/shade");
const { contourInterval, contourPieces } = await module("map/contours");
const { roundedPlace } = await module("map/dragging");

/** Numbers that look random and are the same in each run. */
function numbers(seed) {
  let state = seed;
  return (below) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * below);
  };
}

/** The bytes of a tile, as PROTOCOL.md has them. */
function tileBytes({ seq, id, step, kind, column, row, columns, rows, verdicts, values = [] }) {
  const padded = (bytes) => Math.ceil(bytes / 4) * 4;
  const size = [0, 2, 4][kind];
  const bytes = new ArrayBuffer(32 + padded(verdicts.length) + padded(size * values.length));
  const view = new DataView(bytes);
  view.setUint32(0, bytes.byteLength, true);
  view.setUint32(4, seq, true);
  view.setUint16(8, id, true);
  view.setUint8(10, step);
  view.setUint8(11, kind);
  view.setInt32(12, column, true);
  view.setInt32(16, row, true);
  view.setUint32(20, columns, true);
  view.setUint32(24, rows, true);
  verdicts.forEach((verdict, i) => view.setUint8(32 + i, verdict));
  values.forEach((value, i) =>
    kind === 1
      ? view.setUint16(32 + padded(verdicts.length) + 2 * i, value, true)
      : view.setFloat32(32 + padded(verdicts.length) + 4 * i, value, true),
  );
  return bytes;
}

function joined(buffers) {
  return new Uint8Array(buffers.flatMap((buffer) => [...new Uint8Array(buffer)])).buffer;
}

test("tiles of a message are read one after the other, with their values", () => {
  const first = { seq: 7, id: 3, step: 9, kind: 0, column: -5, row: -700, columns: 3, rows: 1, verdicts: [0, 1, 255] };
  const second = {
    seq: 8,
    id: 2,
    step: 1,
    kind: 2,
    column: 4,
    row: 9,
    columns: 1,
    rows: 2,
    verdicts: [1, 2],
    values: [1.5, -2],
  };
  const third = {
    seq: 9,
    id: 1,
    step: 3,
    kind: 1,
    column: 0,
    row: 0,
    columns: 1,
    rows: 1,
    verdicts: [1],
    values: [65535],
  };
  const tiles = readTiles(joined([first, second, third].map(tileBytes)));
  assert.equal(tiles.length, 3);
  assert.deepEqual(
    { ...tiles[0], verdicts: [...tiles[0].verdicts] },
    { seq: 7, id: 3, step: 9, column: -5, row: -700, columns: 3, rows: 1, verdicts: [0, 1, 255], values: null },
  );
  assert.deepEqual([...tiles[1].values], [1.5, -2]);
  assert.deepEqual([...tiles[2].values], [65535]);
});

const GRID = { seq: 1, cell_m: 10, column: -13, row: -22, columns: 40, rows: 31, kind: 2 };

/** Every `step`-th cell of a grid of verdicts, of those whose squares tile the plane. */
function pass(verdictAt, step) {
  const half = (step - 1) / 2;
  const first = (from) => Math.ceil((from - half) / step) * step + half;
  const column = first(GRID.column);
  const row = first(GRID.row);
  const columns = Math.ceil((GRID.column + GRID.columns - column) / step);
  const rows = Math.ceil((GRID.row + GRID.rows - row) / step);
  const verdicts = [];
  const values = [];
  for (let j = 0; j < rows; ++j) {
    for (let i = 0; i < columns; ++i) {
      verdicts.push(verdictAt(column + i * step, row + j * step));
      values.push(column + i * step);
    }
  }
  return { step, column, row, columns, rows, verdicts, values };
}

test("a cell shows the verdict of the nearest that has one until it has its own", () => {
  const random = numbers(1);
  const verdicts = Array.from({ length: GRID.columns * GRID.rows }, () => [0, 1, 2, 3, 255][random(5)]);
  const verdictAt = (column, row) => verdicts[(row - GRID.row) * GRID.columns + column - GRID.column];
  const cells = new SeenCells(GRID);
  assert(cells.codes.every((code) => code === UNKNOWN));
  for (const step of [9, 3, 1]) {
    const tile = pass(verdictAt, step);
    cells.take(tile);
    assert.equal(cells.step, step);
    cells.codes.forEach((code, k) => {
      const column = (k % GRID.columns) + GRID.column;
      const row = Math.floor(k / GRID.columns) + GRID.row;
      const half = (step - 1) / 2;
      const centre = (at) => Math.floor(at / step) * step + half;
      const i = centre(column);
      const j = centre(row);
      const inside = i >= GRID.column && i < GRID.column + GRID.columns && j >= GRID.row && j < GRID.row + GRID.rows;
      if (!inside) return;
      const verdict = verdictAt(i, j) === 255 ? OUTSIDE : verdictAt(i, j);
      assert.equal(
        code,
        i === column && j === row ? verdict : verdict | NEAREST,
        `cell ${column},${row} after the pass of step ${step}`,
      );
      assert.equal(cells.values[k], i);
    });
  }
});

test("a place is in the cell that covers it", () => {
  const cells = new SeenCells(GRID);
  assert.equal(cells.at(-125, 215), 0);
  assert.equal(cells.at(-129.9, 210.1), 0);
  assert.equal(cells.at(-119.9, 209.9), GRID.columns + 1);
  assert.equal(cells.at(-131, 215), -1);
  assert.equal(cells.at(-125, 221), -1);
});

/** Two masts whose grids lie on the same cells, but not over each other. */
function twoMasts(seed) {
  const random = numbers(seed);
  return [
    [0, 0],
    [7, -4],
  ].map(([column, row], i) => {
    const cells = new SeenCells({ seq: 1, cell_m: 10, column, row, columns: 20, rows: 18, kind: 2 });
    cells.codes.forEach((_, k) => (cells.codes[k] = random(5)));
    cells.values.forEach((_, k) => (cells.values[k] = random(3) === 0 ? NaN : random(150)));
    return { cells, hue: i, selected: i === 0 };
  });
}

function codeAt({ cells }, column, row) {
  const c = column - cells.column;
  const r = row - cells.row;
  return c < 0 || r < 0 || c >= cells.columns || r >= cells.rows ? OUTSIDE : cells.codes[r * cells.columns + c];
}

test("a pixel has the share of its cells that a mast sees", () => {
  const [mast] = twoMasts(2);
  const factor = 3;
  const at = { column: -3, row: -3, columns: 30, rows: 27 };
  const image = paintMosaic(verdictPicture([mast], false), at, factor);
  for (let y = 0; y < 9; ++y) {
    for (let x = 0; x < 10; ++x) {
      let seen = 0;
      let undecided = 0;
      let cut = 0;
      for (let k = 0; k < factor * factor; ++k) {
        const code = codeAt(mast, at.column + x * factor + (k % factor), at.row + y * factor + Math.floor(k / factor));
        seen += code === 1;
        undecided += code === 2;
        cut += code === 3;
      }
      const opacity = (255 * (0.55 * seen + 0.6 * undecided + 0.55 * 0.45 * cut)) / 9;
      assert(Math.abs(image.data[4 * (10 * y + x) + 3] - opacity) < 1, `pixel ${x},${y}`);
    }
  }
});

test("a cell that both masts see has the mixture of their colours, in the difference a grey", () => {
  const masts = twoMasts(3);
  const at = { column: 0, row: 0, columns: 27, rows: 18 };
  const together = paintMosaic(verdictPicture(masts, false), at, 1);
  const difference = paintMosaic(verdictPicture(masts, true), at, 1);
  let both = 0;
  for (let row = 0; row < 18; ++row) {
    for (let column = 0; column < 27; ++column) {
      const sees = masts.map((mast) => codeAt(mast, column, row) === 1);
      const pixel = 4 * (27 * row + column);
      const colourOf = (image) => [...image.data.slice(pixel, pixel + 3)];
      if (sees[0] && sees[1]) {
        ++both;
        const mixed = [0, 1, 2].map((i) => Math.sqrt((HUES[0][i] ** 2 + HUES[1][i] ** 2) / 2));
        colourOf(together).forEach((value, i) => assert(Math.abs(value - mixed[i]) <= 1));
        assert.deepEqual(colourOf(difference), [70, 70, 80]);
      } else if (sees[0] && [0, OUTSIDE].includes(codeAt(masts[1], column, row))) {
        assert.deepEqual(colourOf(together), HUES[0]);
      }
    }
  }
  assert(both > 5);
});

test("of several masts the best value counts", () => {
  const masts = twoMasts(4);
  const mode = VALUE_MODES.height;
  const at = { column: 0, row: 0, columns: 20, rows: 14 };
  const classes = new Uint16Array(20);
  const picture = valuePicture(masts, mode);
  for (let row = 0; row < 14; ++row) {
    classes.fill(0);
    picture.classify(row, at.column, classes);
    for (let column = 0; column < 20; ++column) {
      const values = masts
        .map(({ cells }) => {
          const c = column - cells.column;
          const r = row - cells.row;
          return c < 0 || r < 0 || c >= cells.columns || r >= cells.rows ? NaN : cells.values[r * cells.columns + c];
        })
        .filter((value) => !Number.isNaN(value));
      assert.equal(classes[column], values.length === 0 ? 0 : classOf(mode, Math.min(...values)) + 1);
    }
  }
});

test("cells are counted once, whoever sees them", () => {
  const masts = twoMasts(5);
  const counts = { any: 0, all: 0, onlySelected: 0, looked: 0, area: 100 };
  for (let row = -10; row < 30; ++row) {
    for (let column = -10; column < 40; ++column) {
      const codes = masts.map((mast) => codeAt(mast, column, row));
      const sees = codes.map((code) => code === 1 || code === 3);
      counts.looked += codes.some((code) => code !== OUTSIDE);
      counts.any += sees[0] || sees[1];
      counts.all += sees[0] && sees[1];
      counts.onlySelected += sees[0] && !sees[1];
    }
  }
  assert.deepEqual(tally(masts), counts);
});

test("classes of values have limits, names and the best first", () => {
  assert.deepEqual(
    [0, 2, 2.1, 100, 101].map((value) => classOf(VALUE_MODES.height, value)),
    [0, 0, 1, 5, 6],
  );
  assert.deepEqual(
    [3, 2, 1.5, -5].map((value) => classOf(VALUE_MODES.angle, value)),
    [0, 0, 1, 7],
  );
  assert.equal(className(VALUE_MODES.height, 0), "up to 2 m");
  assert.equal(className(VALUE_MODES.height, 6), "over 100 m");
  assert.equal(className(VALUE_MODES.angle, 5), "−0.5° to −1°");
});

const INFO = {
  bounds: { xmin: 300000, ymin: 170000, xmax: 340000, ymax: 210000 },
  data_spacing_m: 50,
  tiles: { themes: ["buildings"] },
};

test("the address says the whole scene", () => {
  const state = {
    ...firstState(INFO),
    masts: [
      { id: 0, hue: 2, name: "Garth Hill", x: 310375.5, y: 183525, height: 20 },
      { id: 1, hue: 0, name: "B & C", x: 1, y: 2, height: 3 },
    ],
    selected: 1,
    show: "difference",
    target: { x: 5, y: 6 },
    options: { radius: "5000", cell: "20", "effective-earth": "4/3", themes: "none" },
    layers: { relief: "slope", contours: true, themes: [] },
    view: { x: 1, y: 2, resolution: 33.5 },
  };
  assert.deepEqual(readAddress(addressOf(state), firstState(INFO)), state);
  const tied = { ...state, target: { mast: 0 } };
  assert.deepEqual(readAddress(addressOf(tied), firstState(INFO)), tied);
  assert.equal(readAddress("mast=1,2,3,4&target=mast:5", firstState(INFO)).target, null);
  assert.deepEqual(readAddress("", firstState(INFO)), firstState(INFO));
  assert.deepEqual(readAddress("mast=nonsense&selected=9&show=x&at=1,2&relief=7&radius=5", firstState(INFO)).masts, []);
});

test("a line to a mast follows it, and ends with it", () => {
  const scene = new Scene(firstState(INFO));
  scene.addMast({ x: 1, y: 2 });
  scene.addMast({ x: 3, y: 4 });
  scene.change({ selected: 0, target: { mast: 1 } });
  scene.changeMast(1, { x: 5, height: 30 });
  assert.deepEqual([scene.farEnd.x, scene.farEnd.y, scene.farEnd.height, scene.farEnd.name], [5, 4, 30, "Mast B"]);
  scene.removeMast(1);
  assert.equal(scene.state.target, null);
  scene.change({ target: { x: 7, y: 8 } });
  assert.deepEqual(scene.farEnd, { x: 7, y: 8, height: "2", name: "" });
  scene.addMast({ x: 3, y: 4 });
  assert.deepEqual(
    scene.state.masts.map(({ id, hue, name }) => [id, hue, name]),
    [
      [0, 0, "Mast A"],
      [1, 1, "Mast B"],
    ],
  );
});

test("the page opens with round options that suit the data", () => {
  assert.deepEqual(firstState(INFO).options, { radius: "10000", cell: "50", "target-height": "2" });
  assert.deepEqual(
    firstState({ ...INFO, bounds: { xmin: 0, ymin: 0, xmax: 460, ymax: 420 }, data_spacing_m: null }).options,
    { radius: "200", cell: "1", "target-height": "2" },
  );
});

test("what is dragged comes to rest on round coordinates", () => {
  assert.deepEqual(roundedPlace({ x: 318000.37, y: -4.51 }, 50), { x: 318000, y: -5 });
  assert.deepEqual(roundedPlace({ x: 318000.37, y: 4.512 }, 1), { x: 318000.4, y: 4.5 });
});

test("a marker has what tells a mast from others", () => {
  assert.deepEqual(
    ["Mast B", "Site 12", "Garth Hill", "ridge", ""].map((name) => letterOf({ name })),
    ["B", "12", "G", "R", ""],
  );
});

/** A tile of a plane that rises to the east, with a hole. */
function plane(rise) {
  const size = 8;
  const width = size + 2;
  const heights = new Float32Array(width * width);
  heights.forEach((_, k) => (heights[k] = (k % width) * rise));
  heights[3 * width + 4] = NaN;
  return { tile: { heights, width }, size };
}

test("relief is bright towards the north-west, and has no ground where there is none", () => {
  const brightness = (rise) => relief(plane(rise).tile, 8, 10, { relief: "shade", dark: false }).data[4 * (8 * 6 + 6)];
  assert(brightness(3) > brightness(0) && brightness(0) > brightness(-3));
  assert.deepEqual(
    [
      ...relief(plane(8).tile, 8, 10, { relief: "slope", dark: false }).data.slice(
        4 * (8 * 2 + 3),
        4 * (8 * 2 + 3) + 3,
      ),
    ],
    [226, 228, 234],
  );
});

test("contours of a plane are straight, evenly spaced, and end at the hole", () => {
  const { tile, size } = plane(5);
  const levels = new Set();
  for (const { level, x0, x1 } of contourPieces(tile, size, 10)) {
    levels.add(level);
    // Column c of the heights has the middle of pixel c - 1.
    for (const x of [x0, x1]) assert(Math.abs(x - (level / 5 - 0.5)) < 1e-6);
  }
  assert.deepEqual(
    [...levels].sort((a, b) => a - b),
    [10, 20, 30, 40],
  );
  assert.equal(contourInterval(50, 50), 50);
  assert.equal(contourInterval(1, 1), 1);
  assert.equal(contourInterval(1, 50), 10);
});
