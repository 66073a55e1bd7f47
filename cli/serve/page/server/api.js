// What the server answers over HTTP. PROTOCOL.md has the paths and documents.

/**
 * @typedef {object} Info
 * @property {string} store @property {string} version @property {string} itin
 * @property {string} crs @property {string} crs_name
 * @property {{xmin: number, ymin: number, xmax: number, ymax: number}} bounds
 * @property {number | null} data_spacing_m
 * @property {{name: string, kind: string, features: number, left_out?: number}[]} themes
 *   `left_out` are features of the import that do not stand.
 * @property {{tolerance_m: number, query_vertices: number}[]} levels  The finest first.
 * @property {string[]} modes
 * @property {{origin: [number, number], size: number, border: number, resolutions: number[], themes: string[]}} tiles
 */
/** @typedef {Record<string, string | string[]>} Options */
/**
 * @typedef {object} Job
 * @property {string} id @property {Options} options  What was asked.
 * @property {"queued" | "running" | "done" | "failed" | "cancelled"} state
 * @property {string | null} stage @property {number} share @property {number | null} seconds_left
 * @property {string | null} error @property {string} command
 * @property {any} document
 * @property {{name: string, url: string, bytes: number}[]} files
 */
/**
 * @typedef {object} UploadedPlace
 * @property {number} x @property {number} y @property {string} [name] @property {number} [height_m]
 * @property {number} [hub_height_m] @property {number} [rotor_diameter_m] @property {number} [tip_height_m]
 */
/** @typedef {{name: string, rows: number, unusable: number, places: UploadedPlace[], rings: number[][],
 *    warnings: string[]}} Upload  `unusable` counts rows that have no place on the data. */

/** The server's names for files that were sent. */
export const UPLOADED = /upload-[0-9a-f]+\.\w+/g;
const LOOK_EVERY = 300;
/** @type {Record<string, string>} */
const UPLOAD_TYPES = { csv: "text/csv", geojson: "application/geo+json", json: "application/geo+json" };

/** @param {string} path @param {RequestInit} [request] */
async function ask(path, request) {
  const answer = await fetch(path, request);
  if (answer.ok) return answer.status === 204 ? null : answer.json();
  const problem = await answer.json().catch(() => null);
  throw new Error(problem?.error ?? `the server answered ${answer.status} to ${path}`);
}

/** @returns {Promise<Info>} */
export const askInfo = () => ask("/api/v1/info");

/** @typedef {{x: number, y: number, lon: number | null, lat: number | null, grid_reference: string | null,
 *    ground_m: number | null, height_m: number | null}} KnownPlace */

/** Understands a place as the command line does: easting,northing, degrees with N, S, E or W, or a grid reference.
 * @param {string} text @returns {Promise<KnownPlace>} */
export const askPlace = (text) => ask(`/api/v1/place?at=${encodeURIComponent(text)}`);

/** A job that has ended well, or null where the server has none of this id. @param {string} id
 * @returns {Promise<Job | null>} */
export async function askJob(id) {
  const job = /** @type {Job | null} */ (await ask(`/api/v1/jobs/${encodeURIComponent(id)}`).catch(() => null));
  return job?.state === "done" ? job : null;
}

/** What was told of a file that was sent, or null where the server has none of this name. @param {string} name
 * @returns {Promise<Upload | null>} */
export const askUpload = (name) => ask(`/api/v1/uploads/${encodeURIComponent(name)}`).catch(() => null);

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

  /**
   * Waits until a job has ended, or the signal says that it is given up. A page that is left gives it up as well.
   * @param {string} url @param {(job: Job) => void} look  Gets the job now and then.
   * @param {AbortSignal} signal
   * @returns {Promise<Job | null>} null where it was given up
   */
  async ended(url, look, signal) {
    const leave = () => this.cancel(url);
    addEventListener("pagehide", leave);
    try {
      while (!signal.aborted) {
        const job = /** @type {Job} */ (await ask(url));
        look(job);
        if (job.state === "done") return job;
        if (job.state === "failed") throw new Error(job.error ?? "it could not be done");
        await new Promise((resume) => setTimeout(resume, LOOK_EVERY));
      }
    } finally {
      removeEventListener("pagehide", leave);
    }
    await this.cancel(url);
    return null;
  }

  /** Sends a file for jobs to read. @param {string} name  Its ending says what it is. @param {Blob} bytes
   * @returns {Promise<Upload>} */
  send(name, bytes) {
    const type = UPLOAD_TYPES[name.toLowerCase().split(".").at(-1) ?? ""];
    if (!type) throw new Error(`${name}: choose a table (.csv) or GeoJSON (.geojson)`);
    const headers = { "Content-Type": type, "X-Itin-Key": this.key };
    return ask("/api/v1/uploads", { method: "POST", headers, body: bytes });
  }

  /** Lets the server forget a file; jobs that were started keep it. @param {string} name */
  async forget(name) {
    await ask(`/api/v1/uploads/${name}`, { method: "DELETE", headers: { "X-Itin-Key": this.key } });
  }

  /** @param {string} url */
  async cancel(url) {
    await ask(url, { method: "DELETE", headers: { "X-Itin-Key": this.key }, keepalive: true });
  }
}
