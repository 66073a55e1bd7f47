// Which of many places another place means.

/** The place next to another one, within a distance, or null. @template {{x: number, y: number}} Place
 * @param {Place[]} places @param {number[]} place @param {number} within @returns {Place | null} */
export function nearestPlace(places, [x, y], within) {
  /** @type {Place | null} */
  let nearest = null;
  let least = within;
  for (const place of places) {
    const distance = Math.hypot(place.x - x, place.y - y);
    if (distance < least || (distance === least && nearest === null)) {
      nearest = place;
      least = distance;
    }
  }
  return nearest;
}
