// What tests of the page's modules share. scripts/web-packages lays out what they import.

globalThis.ImageData = class {
  constructor(width, height) {
    Object.assign(this, { width, height, data: new Uint8ClampedArray(4 * width * height) });
  }
};

/** A module of the page, by its path without its ending. */
export const module = (name) => import(new URL(`../../build/web/page/${name}.js`, import.meta.url));

/** Numbers that look random and are the same in each run. */
export function numbers(seed) {
  let state = seed;
  return (below) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * below);
  };
}
