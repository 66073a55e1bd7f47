#!/usr/bin/env bash
# The sweep against rays: the same viewsheds by `--engine sweep` and `--engine rays`, over a raster, lidar and a town, for
# dense and sparse cells and for one observer and many. Checks that both write the same bytes, and prints for each the
# time by the clock, the processor time and the peak memory, and the ratio of rays to the sweep.
#   benchmarks/peers/engines.sh
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"
source "$(dirname "${BASH_SOURCE[0]}")/alexandria_store.sh"
require_tools

readonly folder=$work/engines
mkdir -p "$folder"
cd "$folder"
if [ ! -f hills.itin ]; then "$itin" import hills.itin "$root/scripts/demo-data/cardiff.tif" --quiet >/dev/null; fi
if [ ! -f lidar.itin ] && [ -d "$data/derived-las" ]; then
  "$itin" import lidar.itin "$data"/derived-las/ign_*.las --crs EPSG:2154 --quiet >/dev/null
fi

observers() {  # observers COUNT WEST SOUTH EAST NORTH: a table of observers spread over the box
  awk -v n="$1" -v w="$2" -v s="$3" -v e="$4" -v t="$5" \
    'BEGIN { srand(1994); print "x,y"; for (i = 0; i < n; ++i) print w + rand() * (e - w) "," s + rand() * (t - s) }'
}

compare() {  # compare NAME STORE OPTION...
  local name=$1 store=$2 engine
  shift 2
  if [ ! -f "$store.itin" ]; then echo "$name: left out, $data is absent"; return; fi
  echo "$name"
  for engine in sweep rays; do
    measure "$engine" "$itin" viewshed "$store.itin" --engine "$engine" --nodata clear --target-height 2 --quiet --overwrite \
      -o "$engine.tif" "$@"
  done
  cmp sweep.tif rays.tif
  printf '  rays / sweep: %s by the clock, %s of processors\n' "$(ratio rays sweep)" "$(processor_ratio rays sweep)"
}

observers 100 305000 178000 330000 200000 >hills.csv
observers 100 321560 4297560 322000 4297960 >town.csv
compare "raster, 640,000 posts; 1.4 million cells" hills --observer 310375,183525,30 --radius 20000 --cell 25
compare "raster; 3,600 cells" hills --observer 310375,183525,30 --radius 20000 --cell 500
compare "raster; 100 observers, 3,600 cells" hills --observers hills.csv --cell 500
compare "lidar, 519,000 points; 2 million cells" lidar --observer 300000,6801500,5 --cell 1
compare "lidar; 5,000 cells" lidar --observer 300000,6801500,5 --cell 20
compare "town, 84 buildings; 290,000 cells" town --observer 321800,4297750,2 --cell 1
compare "town; 2,900 cells" town --observer 321800,4297750,2 --cell 10
compare "town; 100 observers, 290,000 cells" town --observers town.csv --cell 1
compare "town; 100 observers, 2,900 cells" town --observers town.csv --cell 10
