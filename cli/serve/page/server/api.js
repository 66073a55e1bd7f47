// What the server answers over HTTP. PROTOCOL.md has the paths and documents.

/**
 * @typedef {object} Info
 * @property {string} store @property {string} version @property {string} itin
 * @property {string} crs @property {string} crs_name
 * @property {{xmin: number, ymin: number, xmax: number, ymax: number}} bounds
 * @property {number | null} data_spacing_m
 * @property {{name: string, kind: string, features: number}[]} themes
 * @property {string[]} modes
 * @property {{origin: [number, number], size: number, border: number, resolutions: number[], themes: string[]}} tiles
 */
/** @typedef {Record<string, string | string[]>} Options */
/**
 * @typedef {object} Job
 * @property {"queued" | "running" | "done" | "failed" | "cancelled"} state
 * @property {string} stage @property {number} share @property {string | null} error @property {string} command
 * @property {{name: string, url: string}[]} files
 */

/** @param {string} path @param {RequestInit} [request] */
async function ask(path, request) {
  const answer = await fetch(path, request);
  if (answer.ok) return answer.status === 204 ? null : answer.json();
  const problem = await answer.json().catch(() => null);
  throw new Error(problem?.error ?? `the server answered ${answer.status} to ${path}`);
}

/** @returns {Promise<Info>} */
export const askInfo = () => ask("/api/v1/info");

/** Understands a place as the command line does: easting,northing, degrees with N, S, E or W, or a grid reference.
 * @param {string} text @returns {Promise<{x: number, y: number}>} */
export async function askPlace(text) {
  const end = encodeURIComponent(text);
  const { from } = await ask(`/api/v1/los?from=${end}&to=${end}`);
  return { x: from.x, y: from.y };
}

export class Jobs {
  /** @param {string} key */
  constructor(key) {
    this.key = key;
  }

  /** @param {string} verb @param {Options} options @returns {Promise<string>} the job's address */
  async start(verb, options) {
    const headers = { "Content-Type": "application/json", "X-Itin-Key": this.key };
    return (await ask("/api/v1/jobs", { method: "POST", headers, body: JSON.stringify({ verb, options }) })).url;
  }

  /** @param {string} url @returns {Promise<Job>} */
  look(url) {
    return ask(url);
  }

  /** @param {string} url */
  async cancel(url) {
    await ask(url, { method: "DELETE", headers: { "X-Itin-Key": this.key } });
  }
}
