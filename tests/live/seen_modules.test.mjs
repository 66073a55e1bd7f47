// The page's modules for what masts see: tiles, cells, pictures, views; beside slow and obvious twins.
import assert from "node:assert/strict";
import test from "node:test";

import { module, numbers } from "./page_modules.mjs";

const { readTiles } = await module("server/tile_message");
const { SeenCells, NEAREST, OUTSIDE, UNKNOWN } = await module("seen/seen_cells");
const { verdictPicture, valuePicture } = await module("seen/picture");
const { Mosaic } = await module("seen/mosaic");
const { LiveViews } = await module("seen/live_views");
const { tally } = await module("seen/tally");
const { HUES } = await module("seen/palette");
const { VALUE_MODES, classOf } = await module("seen/values");
const { Scene } = await module("state/scene");

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

/** The pixels of a window, painted at once. */
function painted(picture, at, factor) {
  const mosaic = new Mosaic(at, factor);
  mosaic.paint(picture, at);
  return mosaic.image;
}

test("a pixel has the share of its cells that a mast sees", () => {
  const [mast] = twoMasts(2);
  const factor = 3;
  const at = { column: -3, row: -3, columns: 30, rows: 27 };
  const image = painted(verdictPicture([mast], false), at, factor);
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
      const opacity = (255 * (0.55 * seen + 0.7 * undecided + 0.55 * 0.45 * cut)) / 9;
      assert(Math.abs(image.data[4 * (10 * y + x) + 3] - opacity) < 1, `pixel ${x},${y}`);
    }
  }
});

test("what is painted part by part is what is painted at once, and nothing beside it is touched", () => {
  for (const factor of [1, 3]) {
    const [mast] = twoMasts(5);
    const other = twoMasts(6)[0];
    const at = { column: -3, row: -6, columns: 30, rows: 30 };
    const mosaic = new Mosaic(at, factor);
    mosaic.paint(verdictPicture([mast], false), at);
    const before = [...mosaic.image.data];
    const random = numbers(7);
    const anew = {
      ...mast,
      cells: Object.assign(new SeenCells({ ...GRID, column: 0, row: 0, columns: 20, rows: 18 }), {
        codes: mast.cells.codes.slice(),
      }),
    };
    const picture = verdictPicture([anew], false);
    for (let k = 0; k < 12; ++k) {
      const part = { column: random(24) - 4, row: random(22) - 4, columns: random(9), rows: random(9) };
      for (let row = Math.max(0, part.row); row < Math.min(18, part.row + part.rows); ++row) {
        for (let column = Math.max(0, part.column); column < Math.min(20, part.column + part.columns); ++column) {
          anew.cells.codes[20 * row + column] = other.cells.codes[20 * row + column] | (random(2) ? NEAREST : 0);
        }
      }
      const { x, y, width, height } = mosaic.paint(picture, part);
      const whole = painted(picture, at, factor);
      assert.deepEqual([...mosaic.image.data], [...whole.data], `part ${k}, ${factor} cells to a side of a pixel`);
      whole.data.forEach((value, i) => {
        const pixel = [Math.floor(i / 4) % whole.width, Math.floor(i / 4 / whole.width)];
        const within = pixel[0] >= x && pixel[0] < x + width && pixel[1] >= y && pixel[1] < y + height;
        if (!within) assert.equal(value, before[i]);
        before[i] = value;
      });
    }
  }
});

/** Views of a scene with one mast over a connection that notes what is sent, and pictures that come when told to. */
function watchedViews() {
  const masts = [{ id: 0, hue: 0, name: "A", x: 0, y: 0, height: 20 }];
  const scene = new Scene({ task: "masts", masts, selected: 0, options: { radius: "50", cell: "10" }, turbines: [] });
  const sent = [];
  const heard = {};
  const connection = {
    live: true,
    on: (type, listener) => (heard[type] = listener),
    send: (message) => sent.push(message),
  };
  const pictures = [];
  globalThis.requestAnimationFrame = (draw) => pictures.push(draw);
  const views = new LiveViews(scene, connection);
  const come = [];
  views.onChange((windows) => come.push(windows));
  const tile = (seq) => ({ id: 0, seq, ...pass(() => 1, 9), values: null });
  return {
    ...{ scene, views, sent, heard, come, tile, connection },
    take: (some) => connection.onTile(some),
    draw: () => pictures.splice(0).forEach((draw) => draw()),
    begin: (seq) => heard.begun({ ...GRID, type: "begun", id: 0, seq, kind: 0 }),
    moveTo: (x) => scene.changeMast(0, { x }),
  };
}

test("a move waits for a picture of the one before, and only the last one is sent", () => {
  const { sent, take, tile, begin, draw, moveTo, views } = watchedViews();
  assert.deepEqual(
    sent.map(({ type, seq }) => [type, seq]),
    [["view", 1]],
  );
  moveTo(10);
  moveTo(20);
  begin(1);
  assert.equal(sent.length, 1);
  take(tile(1));
  assert.equal(sent.length, 1);
  draw();
  assert.deepEqual(sent.slice(1), [{ type: "move", id: 0, seq: 2, observer: "20,0,20" }]);
  moveTo(30);
  moveTo(20);
  draw();
  assert.equal(sent.length, 2);
  assert(!views.settled);
  begin(2);
  take(tile(2));
  draw();
  assert.equal(sent.length, 2);
});

test("what comes for a place that the mast has left is let go", () => {
  const { take, tile, begin, draw, moveTo, views, come } = watchedViews();
  begin(1);
  take(tile(1));
  draw();
  assert.equal(come.at(-1), null);
  take(tile(1));
  draw();
  assert.equal(come.at(-1).length, 1);
  moveTo(10);
  take(tile(1));
  draw();
  assert.deepEqual(come.at(-1), []);
  assert.equal(views.of(0).cells.seq, 1);
  begin(2);
  take(tile(1));
  assert.equal(views.of(0).cells.seq, 1);
  take(tile(2));
  draw();
  assert.equal(views.of(0).cells.seq, 2);
  assert.equal(come.at(-1), null);
});

test("without a server nothing is shown of a place that the mast has left", () => {
  const { take, tile, begin, draw, moveTo, views, come, connection, heard, sent } = watchedViews();
  begin(1);
  take(tile(1));
  draw();
  connection.live = false;
  moveTo(10);
  draw();
  assert.equal(views.of(0).cells, null);
  assert.equal(come.at(-1), null);
  connection.live = true;
  heard.welcome({ type: "welcome" });
  assert.equal(sent.at(-1).options.observer, "10,0,20");
});

test("a cell that both masts see has the mixture of their colours, in the difference a grey", () => {
  const masts = twoMasts(3);
  const at = { column: 0, row: 0, columns: 27, rows: 18 };
  const together = painted(verdictPicture(masts, false), at, 1);
  const difference = painted(verdictPicture(masts, true), at, 1);
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
