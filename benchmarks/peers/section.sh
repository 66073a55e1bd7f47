#!/usr/bin/env bash
# Cross-sections and batches of links of 10 km over Wales at full detail, against sampling the raster with GDAL and NumPy,
# and against reading the whole explicit TIN.
#   benchmarks/peers/section.sh
# Single sections are timed by build/release/bin/itin_benchmarks.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"
require_tools gdal_translate
make_terrain
readonly dem=$work/wales.tif store=$work/wales.itin out=$work/section
[ -f "$dem" ] || { echo "$0: needs OS Terrain 50 of Wales in $data" >&2; exit 1; }
mkdir -p "$out"
if [ ! -f "$store" ]; then measure "itin import" "$itin" import --quiet "$store" "$dem"; fi

section() { "$root/benchmarks/peers/section.py" "$@"; }

for side in 30000 1000000; do
  links=$out/links-$side.csv
  [ -f "$links" ] || section links "$dem" $side 10000 10000 "$links"
  echo "10,000 links of 10 km within $((side / 1000)) km:"
  measure "itin los --links, 2 threads" "$itin" los "$store" --quiet --links "$links" -o "$out/links.csv" --overwrite --threads 2
  measure "itin los --links, 1 thread" "$itin" los "$store" --quiet --links "$links" -o "$out/one.csv" --overwrite --threads 1
  cmp "$out/links.csv" "$out/one.csv"
  measure "itin los --links, 6 GHz" "$itin" los "$store" --quiet --links "$links" --frequency 6 --effective-earth 4/3 \
    -o "$out/radio.csv" --overwrite --threads 2
  printf '  %-34s %s\n' "visible" "$(grep -c ',visible,' "$out/links.csv")"
  printf '  %-34s %s\n' "GDAL and NumPy, one core" "$(section raster "$dem" "$links")"
done

echo "one section of 10 km:"
measure "itin profile, a process" "$itin" profile "$store" --quiet --from 280000,240000 --to 286000,248000 \
  -o "$out/profile.csv" --overwrite
ITIN_BENCHMARK_STORE=$store "$root/build/release/bin/itin_benchmarks" --benchmark_filter='BM_Retrieval|BM_Cold|BM_Surface' \
  2>/dev/null | grep ^BM_
if [ ! -f "$out/wales.ply" ]; then measure "itin tin --all" "$itin" tin "$store" --quiet --all -o "$out/wales.ply"; fi
printf '  %-34s %s\n' "the whole explicit TIN" "$(section tin "$out/wales.ply" "$out/links-30000.csv")"
