// licenses.js NODE_MODULES METAFILE...: prints name, version and licence of each package that esbuild's bundles contain.
import { existsSync, readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";

const [modules, ...metafiles] = process.argv.slice(2);

/** The packages of a bundle: what follows the last node_modules/ in the names of its inputs. */
function packagesOf(/** @type {string} */ metafile) {
  const inputs = Object.keys(JSON.parse(readFileSync(metafile, "utf8")).inputs);
  return inputs.flatMap((input) => input.match(/.*node_modules\/((?:@[^/]+\/)?[^/]+)\//)?.[1] ?? []);
}

function licenceText(/** @type {string} */ folder) {
  const file = readdirSync(folder).find((name) => /^licen[cs]e/i.test(name));
  return file && existsSync(join(folder, file)) ? readFileSync(join(folder, file), "utf8").trim() : "";
}

const names = [...new Set(metafiles.flatMap(packagesOf))].sort();
for (const name of names) {
  const folder = join(modules, name);
  const { version, license } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
  console.log(`${name} ${version} (${license})\n\n${licenceText(folder)}\n\n${"-".repeat(80)}\n`);
}
