#!/usr/bin/env bash
# Viewsheds through woods against viewsheds whose woods are solid: a canopy of 1 m over Dartmoor and the New Forest, and
# the greenery of Delft over lidar. Prints for each the time by the clock, the processor time and the peak memory, and the
# ratio of both, which is to be 3 at most.
#   benchmarks/peers/foliage.sh
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"
require_tools unzip jq

readonly folder=$work/foliage canopies=$data/ea-vom-dartmoor-newforest
mkdir -p "$folder"
cd "$folder"
[ -d "$canopies" ] || { echo "$0: $canopies is absent" >&2; exit 1; }

canopy() {  # canopy STORE RASTER TILE...
  local store=$1.itin raster=$2 tile
  shift 2
  if [ -f "$store" ]; then return; fi
  for tile; do
    unzip -o -q "$canopies/tiles/$tile.zip"
    "$itin" import "$store" "${tile^^}.asc" --crs EPSG:27700 --quiet >/dev/null
  done
  "$itin" import "$store" "$canopies/$raster" --kind vegetation --theme canopy --quiet >/dev/null
}

compare() {  # compare NAME STORE OPTION...
  local name=$1 store=$2
  shift 2
  echo "$name"
  measure solid "$itin" viewshed "$store.itin" --target-height 2 --quiet --overwrite -o solid.tif "$@"
  measure foliage "$itin" viewshed "$store.itin" --target-height 2 --quiet --overwrite -o foliage.tif "$@" --foliage \
    --leaf-area off
  printf '  foliage / solid: %s by the clock, %s of processors\n' "$(ratio foliage solid)" \
    "$(processor_ratio foliage solid)"
}

canopy fingle fingle_woods_vom.tif sx78 sx79
canopy forest new_forest_vom.tif su20
if [ ! -f delft.itin ] && [ -d "$data/derived-las" ]; then
  "$itin" import delft.itin "$data"/derived-las/ahn3_cropped_2.las --class 2,9 --crs EPSG:7415 --to-crs EPSG:28992 \
    --quiet >/dev/null
  "$itin" import delft.itin "$data/ahn3-bgt-delft/bgt/bgt_begroeidterreindeel.sqlite" --kind vegetation --height 6 \
    --quiet >/dev/null
fi
compare "Dartmoor, 110,000 pieces of canopy; 1.8 million cells" fingle --observer 274300,89950,25 --radius 1500 --cell 2
compare "Dartmoor; 28,000 cells" fingle --observer 274300,89950,25 --radius 1500 --cell 16
compare "New Forest; 1.8 million cells" forest --observer 425900,108750,25 --radius 1500 --cell 2
if [ -f delft.itin ]; then
  delft_middle=$("$itin" info delft.itin --json --quiet | jq -r '.bounds | "\((.xmin + .xmax) / 2),\((.ymin + .ymax) / 2)"')
  compare "Delft; cells of 1 m" delft --observer "$delft_middle,10" --cell 1
fi
