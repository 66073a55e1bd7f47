#!/usr/bin/env bash
# Imports a town with all its themes: Delft (AHN3 lidar, BGT, CityJSON of 3dfier). Prints processor and wall time of each
# import and of triangulating the whole window, and draws its buildings.
#   benchmarks/peers/delft.sh [WORK_DIR]      needs node and npm (the lidar is LAZ), jq, and ../shared/data
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"
require_tools node npm jq
readonly here=$root/benchmarks/peers delft=$data/ahn3-bgt-delft folder=${1:-$work/delft}
mkdir -p "$folder"
cd "$folder"

[ -d node_modules/laz-perf ] || npm install --silent --no-fund --no-audit laz-perf@0.0.7 >/dev/null
for i in 1 2; do
  [ -f ahn3_$i.las ] || NODE_PATH=node_modules node "$here/las_from_laz.js" "$delft/ahn3/ahn3_cropped_$i.laz" ahn3_$i.las
done

rm -f delft.itin
measure "import of 283,895 ground points" \
  "$itin" import delft.itin ahn3_1.las ahn3_2.las --class 2,9 --crs EPSG:7415 --to-crs EPSG:28992 --quiet
measure "and of 160 buildings" "$itin" import delft.itin "$delft/output/testarea.json" --kind buildings --crs EPSG:7415 --quiet
measure "vegetation, outlines" "$itin" import delft.itin "$delft/bgt/bgt_begroeidterreindeel.sqlite" --kind vegetation --quiet
measure "walls, 2 m high" "$itin" import delft.itin "$delft/bgt/bgt_scheiding.sqlite" --kind walls --height 2 --quiet
measure "roads" "$itin" import delft.itin "$delft/bgt/bgt_wegdeel.sqlite" --kind roads --quiet
measure "the whole window, bare, to PLY" "$itin" tin delft.itin --all --themes none -o bare.ply --overwrite --quiet
measure "the whole window, all themes, to PLY" "$itin" tin delft.itin --all --themes all -o all.ply --overwrite --quiet
measure "the picture of its houses" "$itin" tin delft.itin --all --themes buildings --image delft.jpg --overwrite --quiet
"$itin" info delft.itin --json | jq -c '{vertices, bytes, bytes_per_vertex, themes}'
