#!/usr/bin/env bash
# Features that come to a store of 100 million posts and leave it: 50 walls, and 1,000 houses. Prints for each the time by
# the clock, the processor time and the peak memory; 50 walls are to take 2 s and 500 MB on an idle machine. A copy of the
# file with a sync is measured beside them, since no way of adding can be faster. What is left in the end has to have the
# bytes of the store before.
#   benchmarks/peers/adding.sh [SIDE_KM]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"

readonly folder=$work/adding side=${1:-10}
mkdir -p "$folder"
cd "$folder"
[ -f "fractal-$side.itin" ] || "$(dirname "$itin")/itin_huge_store" "fractal-$side.itin" "$side"

features() {  # features COUNT KIND: lines or boxes about the middle of the store, turned at random
  awk -v n="$1" -v kind="$2" -v side="$side" 'BEGIN {
    srand(7); printf "{\"type\":\"FeatureCollection\",\"features\":["
    for (i = 0; i < n; i++) {
      x = 400000 + side * (200 + 600 * rand()); y = 6000000 + side * (200 + 600 * rand()); t = 1.5 * rand()
      c = cos(t); s = sin(t); u = 5 + 25 * rand(); v = kind == "walls" ? 0 : 5 + 25 * rand()
      printf "%s{\"type\":\"Feature\",\"properties\":{\"h\":%.1f},\"geometry\":", i ? "," : "", 2 + 8 * rand()
      if (kind == "walls") printf "{\"type\":\"LineString\",\"coordinates\":[[%.2f,%.2f],[%.2f,%.2f]]}}", x, y, x + 5 * u * c, y + 5 * u * s
      else printf "{\"type\":\"Polygon\",\"coordinates\":[[[%.2f,%.2f],[%.2f,%.2f],[%.2f,%.2f],[%.2f,%.2f],[%.2f,%.2f]]]}}",
        x, y, x + u * c, y + u * s, x + u * c - v * s, y + u * s + v * c, x - v * s, y + v * c, x, y
    }
    print "]}" }' >"$2.geojson"
}
features 50 walls
features 1000 buildings

copied_and_synced() { cp --reflink=never "$1" copy.itin && sync copy.itin; }
export -f copied_and_synced

cp "fractal-$side.itin" store.itin
measure "a copy of the file, synced" bash -c "copied_and_synced store.itin"
for kind in walls buildings; do
  measure "$kind come" "$itin" import store.itin "$kind.geojson" --kind "$kind" --height-field h --crs EPSG:32630 --quiet
done
for kind in walls buildings; do measure "$kind leave" "$itin" import store.itin --remove "$kind" --quiet; done
cmp store.itin "fractal-$side.itin"
echo "  what is left: the store before, to the byte"
