#!/usr/bin/env bash
# Imports a town with all its themes: Delft (AHN3 lidar, BGT, CityJSON of 3dfier). Prints processor and wall time of each
# import and of triangulating the whole window, and draws its buildings.
#   benchmarks/peers/delft.sh [WORK_DIR]      needs node and npm (the lidar is LAZ), jq, and ../shared/data
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
readonly here=$PWD/benchmarks/peers data=$PWD/../shared/data/ahn3-bgt-delft work=${1:-build/peers/delft}
readonly itin=${ITIN_PROGRAM:-$PWD/build/release/bin/itin}
mkdir -p "$work"
cd "$work"

[ -d node_modules/laz-perf ] || npm install --silent --no-fund --no-audit laz-perf@0.0.7 >/dev/null
for i in 1 2; do
  [ -f ahn3_$i.las ] || NODE_PATH=node_modules node "$here/las_from_laz.js" "$data/ahn3/ahn3_cropped_$i.laz" ahn3_$i.las
done

timed() {  # timed "what" command...
  local what=$1
  shift
  command time -o time.txt -f '%U %S %e' "$@" >/dev/null 2>messages.txt || { cat messages.txt >&2; exit 1; }
  awk -v w="$what" '{ printf "%-44s %7.2f s of processor %7.2f s\n", w, $1 + $2, $3 }' time.txt
}
rm -f delft.itin
timed "import of 283,895 ground points" \
  "$itin" import delft.itin ahn3_1.las ahn3_2.las --class 2,9 --crs EPSG:7415 --to-crs EPSG:28992 --quiet
timed "and of 160 buildings" "$itin" import delft.itin "$data/output/testarea.json" --kind buildings --crs EPSG:7415 --quiet
timed "vegetation, outlines" "$itin" import delft.itin "$data/bgt/bgt_begroeidterreindeel.sqlite" --kind vegetation --quiet
timed "walls, 2 m high" "$itin" import delft.itin "$data/bgt/bgt_scheiding.sqlite" --kind walls --height 2 --quiet
timed "roads" "$itin" import delft.itin "$data/bgt/bgt_wegdeel.sqlite" --kind roads --quiet
timed "the whole window, bare, to PLY" "$itin" tin delft.itin --all --themes none -o bare.ply --overwrite --quiet
timed "the whole window, all themes, to PLY" "$itin" tin delft.itin --all --themes all -o all.ply --overwrite --quiet
timed "the picture of its houses" "$itin" tin delft.itin --all --themes buildings --image delft.jpg --overwrite --quiet
"$itin" info delft.itin --json | jq -c '{vertices, bytes, bytes_per_vertex, themes}'
