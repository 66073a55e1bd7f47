// The profile under the map: ground, what stands on it, the sight line and its Fresnel zone. The sight line is drawn
// straight, over an Earth that bulges.

import { uPlot } from "../vendor/uplot.js";
import { hueCss } from "../seen/palette.js";

/** @typedef {import("./sight_line.js").SightLine} SightLine */
/** @typedef {import("./sight_line.js").Profile} Profile */

const GROUND = 1;
const SURFACE = 2;
const RAY = 3;
const LOW = 4;
const HIGH = 5;

/**
 * @param {Profile} profile
 * @returns {(number | null)[][]} distance in km, then the series in the order of the numbers above
 */
function seriesOf({ distance_m, ground_m, surface_m, ray_m, curvature_m, fresnel_m }) {
  const over = (/** @type {(number | null)[]} */ heights) =>
    heights.map((height, i) => (height === null ? null : height + curvature_m[i]));
  const radii = fresnel_m ?? ray_m.map(() => null);
  const zone = (/** @type {number} */ side) =>
    radii.map((radius, i) => (radius === null ? null : ray_m[i] + curvature_m[i] + side * radius));
  return [distance_m.map((metres) => metres / 1000), over(ground_m), over(surface_m), over(ray_m), zone(-1), zone(1)];
}

/** Distances along the axis, in metres where the line is short. @param {number[]} km */
function distanceTexts(km) {
  const short = (km.at(-1) ?? 0) < 1;
  return km.map((at) => (short ? `${Math.round(1000 * at)} m` : `${at} km`));
}

export class ProfileChart {
  /** @type {uPlot | null} */
  #chart = null;
  /** @type {SightLine | null} */
  #line = null;
  #hue = 0;

  /**
   * @param {HTMLElement} element
   * @param {MediaQueryList} dark
   * @param {(place: {x: number, y: number} | null) => void} onHover
   */
  constructor(element, dark, onHover) {
    this.element = element;
    this.onHover = onHover;
    new ResizeObserver(() => this.#chart?.setSize(this.#size())).observe(element);
    dark.addEventListener("change", () => this.#make());
  }

  /** @param {SightLine | null} line @param {number} hue */
  show(line, hue) {
    const again = this.#chart !== null && line !== null && hue === this.#hue;
    this.#line = line;
    this.#hue = hue;
    if (again && this.#chart) this.#chart.setData(/** @type {any} */ (seriesOf(line.profile)));
    else this.#make();
  }

  /** Puts the cursor at a distance from the mast, or away. @param {number | null} metres */
  point(metres) {
    if (!this.#chart) return;
    const left = metres === null ? -10 : this.#chart.valToPos(metres / 1000, "x");
    this.#chart.setCursor({ left, top: metres === null ? -10 : 10 }, false);
  }

  #size() {
    return { width: Math.max(120, this.element.clientWidth), height: Math.max(90, this.element.clientHeight) };
  }

  #make() {
    this.#chart?.destroy();
    this.#chart = null;
    if (!this.#line) return;
    this.#chart = new uPlot(
      /** @type {any} */ (this.#options()),
      /** @type {any} */ (seriesOf(this.#line.profile)),
      this.element,
    );
  }

  #options() {
    const style = getComputedStyle(this.element);
    const colour = (/** @type {string} */ name) => style.getPropertyValue(name).trim();
    const axis = {
      stroke: colour("--text"),
      grid: { stroke: colour("--rule"), width: 1 },
      ticks: { show: false },
      font: "12px system-ui, sans-serif",
    };
    return {
      ...this.#size(),
      padding: [10, 28, 0, 0],
      legend: { show: false },
      cursor: { y: false, points: { show: false }, drag: { x: false, y: false } },
      scales: {
        x: { time: false },
        y: {
          range: (/** @type {uPlot} */ _, /** @type {number} */ low, /** @type {number} */ high) => margins(low, high),
        },
      },
      axes: [
        { ...axis, size: 26, values: (/** @type {any} */ _, /** @type {number[]} */ at) => distanceTexts(at) },
        {
          ...axis,
          size: 58,
          values: (/** @type {any} */ _, /** @type {number[]} */ at) => at.map((metres) => `${metres} m`),
        },
      ],
      series: this.#series(colour),
      bands: [{ series: [HIGH, LOW], fill: colour("--zone") }],
      hooks: {
        drawClear: [(/** @type {uPlot} */ chart) => this.#shadeObstructions(chart, colour("--blocked"))],
        setCursor: [(/** @type {uPlot} */ chart) => this.#hovered(chart)],
      },
    };
  }

  /** @param {(name: string) => string} colour */
  #series(colour) {
    const bare = { points: { show: false } };
    const edge = { ...bare, stroke: colour("--zone-line"), width: 1 };
    const series = /** @type {any[]} */ (new Array(HIGH + 1));
    series[0] = {};
    series[GROUND] = {
      ...bare,
      stroke: colour("--ground-line"),
      width: 1.5,
      fill: colour("--ground"),
      fillTo: (/** @type {uPlot} */ chart) => chart.scales.y.min,
    };
    series[SURFACE] = { ...bare, stroke: colour("--feature-line"), width: 1 };
    series[RAY] = { ...bare, stroke: hueCss(this.#hue), width: 2 };
    series[LOW] = edge;
    series[HIGH] = edge;
    return series;
  }

  /** @param {uPlot} chart @param {string} colour */
  #shadeObstructions(chart, colour) {
    const { ctx, bbox } = chart;
    ctx.fillStyle = colour;
    for (const { from_m, to_m } of this.#line?.obstructions ?? []) {
      const from = chart.valToPos(from_m / 1000, "x", true);
      const to = chart.valToPos(to_m / 1000, "x", true);
      ctx.fillRect(from, bbox.top, Math.max(2, to - from), bbox.height);
    }
  }

  /** @param {uPlot} chart */
  #hovered(chart) {
    const at = chart.cursor.idx;
    const inside = (chart.cursor.left ?? -1) >= 0;
    if (!this.#line || !inside || at === null || at === undefined) return this.onHover(null);
    const { x, y } = this.#line.profile;
    return this.onHover({ x: x[at], y: y[at] });
  }
}

/** @param {number} low @param {number} high @returns {[number, number]} */
function margins(low, high) {
  const margin = Math.max(1, 0.08 * (high - low));
  return [low - margin, high + margin];
}
