// Uncompressed LAS from LAZ, for machines without a LAZ decoder: node las_from_laz.js IN.laz OUT.las, with the package
// laz-perf of the npm registry.
const fs = require("fs");
const { createLazPerf } = require("laz-perf");

async function main([source, target]) {
  const lazperf = await createLazPerf();
  const file = fs.readFileSync(source);
  const input = lazperf._malloc(file.length);
  lazperf.HEAPU8.set(file, input);
  const reader = new lazperf.LASZip();
  reader.open(input, file.length);
  const length = reader.getPointLength(), count = reader.getCount(), point = lazperf._malloc(length);
  // The header alone: the records between it and the points are of no use without compression.
  const size = file.readUInt16LE(94), header = Buffer.from(file.subarray(0, size));
  header.writeUInt32LE(size, 96);
  header.writeUInt32LE(0, 100);
  header[104] &= 0x3f;
  const points = Buffer.alloc(length * count);
  for (let i = 0; i < count; ++i) {
    reader.getPoint(point);
    points.set(lazperf.HEAPU8.subarray(point, point + length), i * length);
  }
  fs.writeFileSync(target, Buffer.concat([header, points]));
}

main(process.argv.slice(2)).catch((error) => {
  console.error(String(error));
  process.exit(1);
});
