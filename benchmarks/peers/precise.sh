#!/usr/bin/env bash
# Certified and precise viewsheds against gdal_viewshed and GRASS r.viewshed: one mast, the same cells for all.
#   benchmarks/peers/precise.sh [NO_GRASS] [CASE...]    cases: cardiff pillars lidar rainier wales-10 wales-40 wales
#                                                       fractal fractal-8192; all where none is given
# Prints time, processor time, peak memory and agreement (IoU of the visible cells) with `itin viewshed --precise`, which
# equals brute force on the stored surface cell for cell (tests/viewshed). Certified tolerances are tried from the coarsest
# until one decides 95 % of the cells. Peers get the raster cut to the radius; itin reads its store of the whole raster.
# Aims: certified no slower than gdal_viewshed; precise at most 4 times as slow as it, and 25 times faster than
# r.viewshed; all below 1 GB.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"
require_tools gdal_viewshed gdalwarp
with_grass=true
if [ "${1:-}" = NO_GRASS ]; then with_grass=false; shift; else require_tools grass; fi
wanted=" ${*:-all} "

readonly eye=30 target=2 refraction=0.13
readonly tolerances=(8 4 2 1 0.5)
export eye target refraction

decided() { sed -n 's/.*(\([0-9.]*\) % decided).*/\1/p' "$1"; }
agreement() { "$root/benchmarks/peers/agreement.py" "$@"; }

grass_viewshed() {  # grass_viewshed DEM X Y RADIUS OUT
  local reach=()
  if [ "$4" != 0 ]; then reach=(max_distance="$4"); fi
  export reach_option="${reach[*]}"
  grass --tmp-location "$1" --exec bash -c "
    set -e
    r.in.gdal -o --quiet input='$1' output=dem
    g.region raster=dem
    r.viewshed -c -r -b --quiet input=dem output=seen coordinates=$2,$3 observer_elevation=$eye \
      target_elevation=$target refraction_coeff=$refraction memory=4000 \$reach_option
    r.out.gdal --quiet input=seen output='$5' type=Byte nodata=255 --overwrite"
}
export -f grass_viewshed

# against A B: the processor time of A, in multiples of B's.
against() { printf '%s x %s' "$(processor_ratio "$1" "$2")" "$2"; }

compare() {  # compare CASE STORE DEM X Y RADIUS (0: the whole raster)
  local name=$1 store=$work/$2.itin dem=$3 x=$4 y=$5 radius=$6 out=$work/$1-precise t
  if [[ "$wanted" != *" $name "* && "$wanted" != " all " ]]; then return; fi
  if [ ! -f "$dem" ]; then echo "$name: left out, no $dem"; return; fi
  mkdir -p "$out"
  rm -f "$out"/*
  local cells=$dem
  if [ "$radius" != 0 ]; then
    cells=$out/cells.tif
    gdal_translate -q -projwin $((x - radius - 100)) $((y + radius + 100)) $((x + radius + 100)) $((y - radius - 100)) \
      "$dem" "$cells"
  fi
  echo "$name: mast at $x,$y, $eye m up, targets $target m up, radius $radius"
  if [ ! -f "$store" ]; then measure "itin import" "$itin" import --quiet "$store" "$dem"; fi
  local call=("$itin" viewshed "$store" --observer "$x,$y,$eye" --target-height $target --like "$cells" --nodata clear --quiet)
  if [ "$radius" != 0 ]; then call+=(--radius "$radius"); else call+=(--radius 1e6); fi
  measure gdal_viewshed gdal_viewshed -q -ox "$x" -oy "$y" -oz $eye -tz $target -md "$radius" -vv 1 -iv 0 -ov 255 \
    -cc "$(awk "BEGIN { print 1 - $refraction }")" "$cells" "$out/gdal.tif"
  if $with_grass; then measure r.viewshed bash -c "grass_viewshed '$cells' $x $y $radius '$out/grass.tif'"; fi
  for t in "${tolerances[@]}"; do
    rm -f "$out/certified.tif"
    measure "certified, $t m" bash -c '"$@" >"$0"' "$out/certified.txt" "${call[@]}" --mode certified --tolerance "$t" \
      -o "$out/certified.tif"
    printf '  %-34s %9s %% decided; %s\n' "" "$(decided "$out/certified.txt")" "$(against "certified, $t m" gdal_viewshed)"
    if awk "BEGIN { exit !($(decided "$out/certified.txt") >= 95) }"; then break; fi
  done
  measure precise "${call[@]}" --precise -o "$out/precise.tif"
  printf '  %-34s %s' "" "$(against precise gdal_viewshed)"
  if $with_grass; then printf '; r.viewshed takes %s' "$(against r.viewshed precise)"; fi
  echo
  printf '  %-34s %s\n' gdal_viewshed "$(agreement "$out/precise.tif" "$out/gdal.tif")"
  if $with_grass; then printf '  %-34s %s\n' r.viewshed "$(agreement "$out/precise.tif" "$out/grass.tif")"; fi
}

make_surfaces() {
  if [ ! -f "$work/pillars.tif" ]; then "$root/benchmarks/peers/surfaces.py" pillars "$work/pillars.tif"; fi
  local las=("$data"/derived-las/ign_0?00_6802.las "$data"/derived-las/ign_0299_6802.las)
  if [ ! -f "$work/lidar.tif" ] && [ -f "${las[1]}" ]; then
    "$root/benchmarks/peers/surfaces.py" lidar "$work/lidar.tif" "${las[@]}"
  fi
  local rainier=$data/srtm90-alpine/mt_rainier_90m.tif
  if [ ! -f "$work/rainier.tif" ] && [ -f "$rainier" ]; then
    gdalwarp -q -t_srs EPSG:32610 -tr 75 75 -r bilinear -dstnodata -32768 -ot Float32 "$rainier" "$work/rainier.tif"
  fi
  if [ ! -f "$work/fractal-8192.tif" ] && [[ "$wanted" == *" fractal-8192 "* || "$wanted" == " all " ]]; then
    "$root/benchmarks/peers/fractal.py" "$work/fractal-8192.part.tif" 8192
    mv "$work/fractal-8192.part.tif" "$work/fractal-8192.tif"
  fi
}

make_terrain
make_surfaces
compare cardiff cardiff "$root/scripts/demo-data/cardiff.tif" 310375 183525 0
compare pillars pillars "$work/pillars.tif" 501022 6001022 0
compare lidar lidar "$work/lidar.tif" 300000 6801500 0
compare rainier rainier "$work/rainier.tif" 594475 5189025 0
compare wales-10 wales "$work/wales.tif" 310375 183525 10000
compare wales-40 wales "$work/wales.tif" 310375 183525 40000
compare wales wales "$work/wales.tif" 310375 183525 0
compare fractal fractal "$work/fractal.tif" 420485 6020485 0
compare fractal-8192 fractal-8192 "$work/fractal-8192.tif" 440485 6040485 0
