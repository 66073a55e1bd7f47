// What is done to the scene's wind turbines.

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./scene.js").Place} Place */
/** @typedef {Place & {id: number, name: string, hub: number | null, tip: number}} Turbine
 *    `hub` and `tip` are heights above the ground; the hub's may be unknown. */

export const MOST_TURBINES = 200;
export const USUAL_SIZE = { hub: 90, tip: 145 };

/** The blades' circle, or nothing where the hub is unknown. @param {{hub: number | null, tip: number}} turbine */
export const rotorOf = ({ hub, tip }) => (hub === null ? null : 2 * (tip - hub));

/** What all turbines share of a size, or null where they differ. @param {Turbine[]} turbines
 * @param {(turbine: Turbine) => number | null} size */
export function commonSize(turbines, size) {
  const first = turbines.length > 0 ? size(turbines[0]) : null;
  return turbines.every((turbine) => size(turbine) === first) ? first : null;
}

/** Adds a turbine of the size of the one before, and selects it. @param {Scene} scene @param {Place} place */
export function addTurbine(scene, place) {
  const { turbines } = scene.state;
  if (turbines.length >= MOST_TURBINES) return;
  const id = Math.max(-1, ...turbines.map((turbine) => turbine.id)) + 1;
  const { hub, tip } = turbines.at(-1) ?? USUAL_SIZE;
  const turbine = { id, name: `T${id + 1}`, hub, tip, ...place };
  scene.change({ turbines: [...turbines, turbine], turbine: id });
}

/** @param {Scene} scene @param {number} id @param {Partial<Turbine>} parts */
export function changeTurbine(scene, id, parts) {
  const { turbines } = scene.state;
  scene.change({ turbines: turbines.map((turbine) => (turbine.id === id ? { ...turbine, ...parts } : turbine)) });
}

/** @param {Scene} scene @param {number} id */
export function removeTurbine(scene, id) {
  const turbines = scene.state.turbines.filter((turbine) => turbine.id !== id);
  scene.change({
    turbines,
    turbine: turbines.at(-1)?.id ?? null,
    ...(turbines.length === 0 ? { viewpoint: null } : {}),
  });
}

/** Gives all turbines a hub height, and blades that reach from there. @param {Scene} scene
 * @param {number} hub @param {number} rotor */
export function resizeTurbines(scene, hub, rotor) {
  scene.change({ turbines: scene.state.turbines.map((turbine) => ({ ...turbine, hub, tip: hub + rotor / 2 })) });
}

/** Takes a layout in place of the turbines there are. @param {Scene} scene
 * @param {import("../server/api.js").UploadedPlace[]} places */
export function takeLayout(scene, places) {
  const { hub: usualHub, tip: usualTip } = scene.state.turbines[0] ?? USUAL_SIZE;
  const turbines = places.slice(0, MOST_TURBINES).map((place, id) => {
    const { x, y, name = `T${id + 1}`, hub_height_m, rotor_diameter_m, tip_height_m } = place;
    const known = hub_height_m !== undefined && rotor_diameter_m !== undefined;
    const tip = tip_height_m ?? (known ? hub_height_m + rotor_diameter_m / 2 : usualTip);
    const hub = hub_height_m ?? (tip_height_m === undefined ? usualHub : null);
    return { id, name, x, y, hub, tip };
  });
  scene.change({ turbines, turbine: turbines[0]?.id ?? null, viewpoint: null, placing: false });
}
