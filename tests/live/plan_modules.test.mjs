// The page's modules for turbines and choices of sites that need no browser.
import assert from "node:assert/strict";
import test from "node:test";

import { module } from "./page_modules.mjs";

const { SeenCells } = await module("seen/seen_cells");
const { classOf, className, countMode } = await module("seen/values");
const { addressOf, readAddress, readChoice } = await module("state/address");
const { Scene } = await module("state/scene");
const { firstState } = await module("state/first_state");
const { areaOf, isMoved, moveSite, polygonText, putBack, sitesOf } = await module("state/plan");
const { addTurbine, commonSize, removeTurbine, resizeTurbines, rotorOf, takeLayout } = await module("state/turbines");
const { cellsIn, encloses, servedOf, MOST_CELLS_SERVED } = await module("state/served");
const { TIPS, HUBS, wantedOf } = await module("seen/viewers");
const { placesIn, rowsIn, turbineTable } = await module("plan/tables");
const { nearestPlace } = await module("state/nearest");
const { buildingsOf } = await module("state/premises");
const { jobOptions } = await module("plan/job_options");
const { extentFor, toleranceFor } = await module("relief/window");
const { middleSeen } = await module("seen/middle_seen");

const INFO = {
  bounds: { xmin: 300000, ymin: 170000, xmax: 340000, ymax: 210000 },
  data_spacing_m: 50,
  tiles: { themes: ["buildings"] },
};

test("buildings of a survey have how they are served, and are found near the cursor", () => {
  const head = "theme,name,id,service,verdict,mast,on,x,y,height_m,blocked_by,blocking_feature,blocked_by_itself";
  const rows = rowsIn(
    `${head}\nhouses,"No. 1, a",1,wall,served,A,wall,10,20,3.000,,,\nhouses,2,2,not served,hidden,A,roof,40,20,5,terrain,,no\n` +
      "houses,3,3,not served,hidden,A,wall,70,20,3,houses,feature 2,no\nhouses,4,4,out of reach,,,,,,,,,\n",
  );
  const buildings = buildingsOf(rows);
  assert.deepEqual(
    buildings.map(({ name, how }) => [name, how]),
    [
      ["houses, No. 1, a", "by A, from 3 m up"],
      ["houses, 2", "hidden by the ground"],
      ["houses, 3", "hidden by houses, feature 2"],
    ],
  );
  assert.equal(nearestPlace(buildings, [42, 21], 5)?.name, "houses, 2");
  assert.equal(nearestPlace(buildings, [42, 28], 5), null);
  assert.equal(nearestPlace([], [0, 0], 5), null);
});

test("counts have bands of equal width, and none seen is no value", () => {
  const few = countMode(3, "blade tip");
  assert.deepEqual(
    [1, 2, 3].map((count) => className(few, classOf(few, count))),
    ["1", "2", "3"],
  );
  const many = countMode(16, "hub");
  for (let count = 1; count <= 16; ++count) {
    const [from, to = from] = className(many, classOf(many, count)).split(" to ").map(Number);
    assert(from <= count && count <= to && to - from <= 2, String(count));
  }
  assert.equal(many.title, "Hubs seen");
  const cells = new SeenCells({ seq: 1, cell_m: 1, column: 0, row: 0, columns: 3, rows: 1, kind: 1, ground_m: [] });
  const tile = { seq: 1, step: 1, column: 0, row: 0, columns: 3, rows: 1, verdicts: [1, 0, 255] };
  cells.take({ ...tile, values: new Uint16Array([2, 0, 65535]) });
  assert.deepEqual([...cells.values], [2, NaN, NaN]);
});

test("the address says turbines, where they are seen from, and where sites are looked for", () => {
  const state = {
    ...firstState(INFO),
    task: "turbines",
    turbines: [
      { id: 0, name: "A, B", x: 1.5, y: 2, hub: 90, tip: 145 },
      { id: 1, name: "C", x: 3, y: 4, hub: null, tip: 100 },
    ],
    turbine: 0,
    part: "hubs",
    viewpoint: { x: 5, y: 6 },
    search: { ring: [0, 0, 10, 0, 10, 10] },
  };
  assert.deepEqual(readAddress(addressOf(state), firstState(INFO)), state);
  const odd = readAddress("task=x&turbine=1,2&viewpoint=1&area=1,2,3,4,5", firstState(INFO));
  assert.deepEqual([odd.task, odd.turbines, odd.turbine, odd.viewpoint, odd.search], ["masts", [], null, null, null]);
});

test("turbines share a size until a layout gives them others", () => {
  const scene = new Scene({ ...firstState(INFO), task: "turbines" });
  addTurbine(scene, { x: 1, y: 2 });
  resizeTurbines(scene, 60, 80);
  addTurbine(scene, { x: 3, y: 4 });
  assert.deepEqual(
    scene.state.turbines.map(({ name, hub, tip }) => [name, hub, tip]),
    [
      ["T1", 60, 100],
      ["T2", 60, 100],
    ],
  );
  removeTurbine(scene, 0);
  addTurbine(scene, { x: 5, y: 6 });
  assert.deepEqual(
    scene.state.turbines.map(({ id }) => id),
    [1, 2],
  );
  takeLayout(scene, [
    { x: 1, y: 2, name: "A", hub_height_m: 90, rotor_diameter_m: 110 },
    { x: 1, y: 2, tip_height_m: 120 },
    { x: 1, y: 2 },
  ]);
  assert.deepEqual(
    scene.state.turbines.map(({ name, hub, tip }) => [name, hub, tip]),
    [
      ["A", 90, 145],
      ["T2", null, 120],
      ["T3", 60, 100],
    ],
  );
  assert.equal(commonSize(scene.state.turbines, rotorOf), null);
  const wanted = wantedOf({ ...scene.state, options: { radius: "5", mode: "height", "target-on": "surface" } });
  assert.deepEqual(wanted, [
    { id: TIPS, options: { radius: "5", mode: "count" }, observer: ["1,2,145", "1,2,120", "1,2,100"] },
    { id: HUBS, options: { radius: "5", mode: "count" }, observer: ["1,2,90", "1,2,60"] },
  ]);
});

test("tables are written and read as the program does it", async () => {
  const table = turbineTable([
    { id: 0, name: 'A "1", B', x: 1.5, y: 2, hub: 90, tip: 145 },
    { id: 1, name: "", x: 3, y: 4, hub: null, tip: 100 },
  ]);
  assert.equal(
    await table.text(),
    'name,x,y,hub_height,rotor_diameter,tip_height\n"A ""1"", B",1.5,2,90,110,145\n"",3,4,,,100\n',
  );
  assert.deepEqual(placesIn('id,x,y,what\n"a, b",1,2,"x"\n2,3.5,4,\n'), [
    { x: 1, y: 2 },
    { x: 3.5, y: 4 },
  ]);
});

test("a verb of the program gets the options that it has", () => {
  const options = { radius: "5", cell: "1", mode: "height", frequency: "2", "target-height": "3", themes: "none" };
  assert.deepEqual(jobOptions("ztv", options), { radius: "5", cell: "1", themes: "none", "observer-height": "3" });
  assert.deepEqual(jobOptions("premises", options), { radius: "5", frequency: "2", themes: "none" });
  assert.equal(jobOptions("site", {})["target-height"], "0");
});

test("sites are moved by hand and put back", () => {
  const scene = new Scene({ ...firstState(INFO), task: "sites" });
  const sites = sitesOf([
    { id: "7", x: 1, y: 2, height_m: 20, gain: 5 },
    { id: "9", x: 3, y: 4, height_m: 20, gain: 2 },
  ]);
  scene.change({ plan: { sites, selected: sites[0].id, candidates: [], result: {} } });
  moveSite(scene, sites[1].id, { x: 8, y: 9 });
  assert.equal(scene.state.plan.selected, sites[1].id);
  assert.deepEqual(scene.state.plan.sites.map(isMoved), [false, true]);
  assert.deepEqual(
    wantedOf(scene.state).map(({ observer }) => observer),
    ["1,2,20", "8,9,20"],
  );
  putBack(scene);
  assert.deepEqual(scene.state.plan.sites.map(isMoved), [false, false]);
  assert.equal(areaOf([0, 0, 4, 0, 4, 3]), 6);
  assert.equal(polygonText([0, 0, 4, 0, 4, 3]), "POLYGON ((0 0, 4 0, 4 3, 0 0))");
});

test("the 3-D view shows what lies about the masts, as closely as a browser can", () => {
  const levels = [
    { tolerance_m: 0, query_vertices: 640000 },
    { tolerance_m: 1, query_vertices: 300000 },
    { tolerance_m: 4, query_vertices: 90000 },
  ];
  const info = { ...INFO, levels };
  assert.deepEqual(extentFor(info, [{ x: 305000, y: 190000 }], 10000, []), [300000, 180000, 315000, 200000]);
  assert.deepEqual(extentFor(info, [], 10000, [320000, 180000, 350000, 190000]), [320000, 180000, 340000, 190000]);
  assert.deepEqual(extentFor(info, [], NaN, [0, 0, 1, 1]), [300000, 170000, 340000, 210000]);
  assert.equal(toleranceFor(info, [300000, 180000, 315000, 200000]), 0);
  assert.equal(toleranceFor(info, [300000, 170000, 320000, 210000]), 1);
  assert.equal(toleranceFor(info, [300000, 170000, 340000, 210000]), 4);
});

test("an eye looks to the middle of what it sees", () => {
  const cells = new SeenCells({ seq: 1, cell_m: 10, column: 2, row: -9, columns: 4, rows: 3, kind: 0, ground_m: [] });
  assert.equal(middleSeen(cells), null);
  cells.codes[5] = cells.codes[7] = 1;
  assert.deepEqual(middleSeen(cells), { x: 45, y: 75 });
});

test("what is to be served is cells of the map whose middles lie in the area", () => {
  const triangle = [100, 100, 400, 100, 100, 400];
  const cells = cellsIn(triangle, 20);
  const all = new Set();
  for (let x = 90; x < 420; x += 20) {
    for (let y = 90; y < 420; y += 20) if (encloses(triangle, x, y)) all.add(`${x},${y}`);
  }
  assert.deepEqual(new Set(cells.map(({ x, y }) => `${x},${y}`)), all);
  assert.ok(cells.every(({ x, y }) => x > 100 && y > 100 && x + y < 500 && x % 20 === 10 && y % 20 === 10));
  assert.throws(
    () => cellsIn([0, 0, 1e5, 0, 1e5, 1e5, 0, 1e5], 20),
    /has more than 100000 cells: take a cell of 316\.\d m/,
  );
  assert.equal(cellsIn([0, 0, 1, 0, 1, 1], 20).length, 0);
  const least = 1e5 / Math.sqrt(MOST_CELLS_SERVED);
  assert.ok(cellsIn([0, 0, 1e5, 0, 1e5, 1e5, 0, 1e5], Math.ceil(least)).length <= MOST_CELLS_SERVED);
});

test("the address has what is to be served", () => {
  for (const served of [
    { kind: "view" },
    { kind: "premises" },
    { kind: "reach" },
    { kind: "area", ring: [1, 2, 3, 4, 5, 7] },
    servedOf("places"),
    servedOf("area"),
  ]) {
    const state = { ...firstState(INFO), task: "sites", served };
    assert.deepEqual(readAddress(addressOf(state), firstState(INFO)).served, served);
  }
});

test("the address names files by what the server and the planner call them, and a choice with what was moved", () => {
  const sent = { upload: "upload-7a.csv", file: "homes, north & south.csv", places: [] };
  const sites = [1, 2, 3].map((x) => ({ x, y: 5, chosen: { x: 2, y: 5 } }));
  const state = {
    ...firstState(INFO),
    task: "sites",
    search: { ...sent, rings: [] },
    served: { kind: "places", ...sent },
    siting: { count: "4", height: "20", spacing: "250" },
    plan: { job: { id: "9f2c" }, sites },
  };
  const address = addressOf(state);
  const read = readAddress(address, firstState(INFO));
  assert.deepEqual(read.siting, state.siting);
  assert.deepEqual(read.options, state.options);
  for (const { upload, file } of [read.search, read.served]) {
    assert.deepEqual([upload, file], [sent.upload, sent.file]);
  }
  assert.deepEqual(readChoice(address), {
    job: "9f2c",
    moved: [
      { site: 0, x: 1, y: 5 },
      { site: 2, x: 3, y: 5 },
    ],
  });
  assert.equal(readChoice("site=1,2,3"), null);
  assert.deepEqual(readAddress("served=upload-x&candidates=odd,file", firstState(INFO)).search, null);
});
