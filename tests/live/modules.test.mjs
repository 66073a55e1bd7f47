// The page's modules that need no browser: its address, words and relief.
import assert from "node:assert/strict";
import test from "node:test";

import { module, numbers } from "./page_modules.mjs";

const { VALUE_MODES, classOf, className } = await module("seen/values");
const { addressOf, readAddress } = await module("state/address");
const { letterOf } = await module("state/mast_letter");
const { countingIn, modeNamed, neededIn, withMode } = await module("state/mode");
const { History } = await module("state/history");
const { Scene } = await module("state/scene");
const { firstState } = await module("state/first_state");
const { relief } = await module("map/shade");
const { contourInterval, contourPieces } = await module("map/contours");
const { contourLabels, joined } = await module("map/contour_labels");
const { roundedPlace } = await module("map/dragging");

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

test("a mode asks for the options that count in it, and keeps the others for later", () => {
  const typed = { cell: "50", frequency: "7", fresnel: "0.8", polarisation: "v", "vertical-error": "3" };
  const asked = (mode) => countingIn(withMode(typed, mode));
  assert.deepEqual(asked("visible"), { cell: "50", frequency: "7", fresnel: "0.8" });
  assert.deepEqual(asked("loss"), { cell: "50", frequency: "7", polarisation: "v", loss: "true" });
  assert.deepEqual(asked("height"), { cell: "50", mode: "height" });
  assert.deepEqual(asked("probability"), { cell: "50", mode: "probability", "vertical-error": "3" });
  for (const mode of ["visible", "loss", "height", "probability"]) {
    assert.equal(modeNamed(withMode(typed, mode)), mode);
    assert.deepEqual(withMode(withMode(typed, mode), "visible"), typed);
  }
  assert.deepEqual(countingIn({ mode: "visible", frequency: "7" }), { frequency: "7" });
  assert.deepEqual(countingIn({ loss: "true" }), { loss: "true", frequency: "5.8" });
  assert.deepEqual(neededIn({ mode: "probability" }), { "vertical-error": "1" });
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

test("gestures are taken back one by one, and done again until something else is done", () => {
  const random = numbers(Number(process.env.ITIN_TEST_SEED ?? 7));
  for (let run = 0; run < 20; ++run) {
    const scene = new Scene(firstState(INFO));
    const history = new History(scene);
    const now = () => JSON.stringify([scene.state.masts, scene.state.options]);
    // All that was planned, one after the other, and which of these it is now.
    let planned = [now()];
    let at = 0;
    const gestures = [
      () => scene.addMast({ x: random(1000), y: random(1000) }),
      () => {
        // A drag is one gesture of many changes.
        const id = scene.state.selected ?? 0;
        for (let i = 0; i < 3; ++i) scene.changeMast(id, { x: random(1000) });
      },
      () => scene.state.selected !== null && scene.removeMast(scene.state.selected),
      () => scene.setOption("target-height", String(random(50))),
      () => scene.change({ view: { x: random(9), y: 0, resolution: 1 } }), // no step: nothing is planned by it
    ];
    for (let step = 0; step < 60; ++step) {
      const what = random(8);
      if (what === 6) {
        assert.equal(history.canUndo, at > 0);
        history.undo();
        at = Math.max(0, at - 1);
      } else if (what === 7) {
        assert.equal(history.canRedo, at < planned.length - 1);
        history.redo();
        at = Math.min(planned.length - 1, at + 1);
      } else {
        history.begin();
        const before = scene.state;
        gestures[what % gestures.length]();
        if (scene.state.masts !== before.masts || scene.state.options !== before.options) {
          planned = [...planned.slice(0, at + 1), now()];
          at += 1;
        }
      }
      assert.equal(now(), planned[at]);
    }
  }
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

/** The contours of a tile whose heights are a function of the place, in pixels. */
function contoursOf(size, interval, height) {
  const width = size + 2;
  const heights = Float32Array.from({ length: width * width }, (_, k) =>
    height((k % width) - 0.5, Math.floor(k / width) - 0.5),
  );
  return contourPieces({ heights, width }, size, interval);
}

test("pieces of a contour are joined to lines and rings, each once", () => {
  const pieces = contoursOf(64, 10, (x, y) => 100 - Math.hypot(x - 20, y - 30));
  for (const level of [90, 80, 70, 60]) {
    const some = pieces.filter((piece) => piece.level === level);
    const lines = joined(some);
    assert.equal(
      lines.reduce((sum, line) => sum + line.length - 1, 0),
      some.length,
    );
    const [ring] = lines;
    if (level !== 90) continue;
    assert.equal(lines.length, 1);
    assert.ok(Math.hypot(ring[0].x - ring.at(-1).x, ring[0].y - ring.at(-1).y) < 0.01);
  }
});

test("labels of contours are upright, along heavier lines, apart from each other and within their tile", () => {
  const size = 256;
  const slope = (x, y) => 200 + 0.3 * x + 0.5 * y + 12 * Math.sin(x / 40);
  for (const scale of [1, 2, 4]) {
    const labels = contourLabels(contoursOf(size, 5, slope), size, 5, scale);
    assert.ok(labels.length >= 2 && labels.length <= 6 * scale ** 2, `${labels.length} labels`);
    labels.forEach(({ text, x, y, angle }, i) => {
      assert.equal(Number(text) % 25, 0);
      assert.ok(angle > -Math.PI / 2 && angle <= Math.PI / 2);
      assert.ok(Math.min(x, y, size - x, size - y) > 5 / scale);
      assert.ok(Math.abs(slope(x, y) - Number(text)) < 2, `${text} at ${slope(x, y)}`);
      // The line's direction is across the slope.
      const across = Math.atan2(-(0.3 + (12 / 40) * Math.cos(x / 40)), 0.5);
      assert.ok(Math.abs(Math.tan(angle) - Math.tan(across)) < 0.5);
      for (const other of labels.slice(i + 1)) assert.ok(Math.hypot(other.x - x, other.y - y) >= 130 / scale);
    });
  }
  // Where no heavier line has room, others have their heights.
  const [low] = contourLabels(
    contoursOf(size, 0.5, (x) => x / 400 - 0.9),
    size,
    0.5,
    1,
  );
  assert.equal(low.text, "−0.5");
  assert.deepEqual(
    contourLabels(
      contoursOf(size, 10, () => 5),
      size,
      10,
      1,
    ),
    [],
  );
});
