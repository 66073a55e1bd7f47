#!/usr/bin/env bash
# itin viewshed against gdal_viewshed and GRASS r.viewshed: same DEM, observer, grid, curvature and refraction.
#   benchmarks/peers/viewshed.sh              the synthetic fractal and OS Terrain 50 of Wales
#   benchmarks/peers/viewshed.sh NO_GRASS     without r.viewshed, which takes most of the time
# Prints wall time, peak memory and the intersection over union of the visible cells with itin's full-detail answer.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"
require_tools gdal_viewshed gdalinfo
with_grass=true
if [ "${1:-}" = NO_GRASS ]; then with_grass=false; else require_tools grass; fi

readonly refraction=0.13
readonly eye=2
readonly tolerances=(1 2 4 8)

grass_viewshed() {  # grass_viewshed DEM X Y OUT
  grass --tmp-location "$1" --exec bash -c "
    set -e
    r.in.gdal -o --quiet input='$1' output=dem
    g.region raster=dem
    r.viewshed -c -r -b --quiet input=dem output=seen coordinates=$2,$3 observer_elevation=$eye target_elevation=0 \
      refraction_coeff=$refraction memory=4000
    r.out.gdal --quiet input=seen output='$4' type=Byte nodata=255 --overwrite"
}
export -f grass_viewshed
export eye refraction

compare() {  # compare NAME X Y
  local name=$1 x=$2 y=$3 dem=$work/$1.tif out=$work/$1-viewshed
  echo "$name: observer $x,$y, $eye m up"
  mkdir -p "$out"
  rm -f "$out"/*.tif
  if [ ! -f "$work/$name.itin" ]; then measure "itin import" "$itin" import --quiet "$work/$name.itin" "$dem"; fi
  local itin_call=("$itin" viewshed "$work/$name.itin" --quiet --observer "$x,$y,$eye" --radius 1e6 --like "$dem")
  measure "itin, every point" "${itin_call[@]}" -o "$out/itin-0.tif"
  local t
  for t in "${tolerances[@]}"; do
    measure "itin, tolerance $t m" "${itin_call[@]}" --tolerance "$t" -o "$out/itin-$t.tif"
  done
  measure "gdal_viewshed" gdal_viewshed -q -ox "$x" -oy "$y" -oz $eye -tz 0 -md 0 -vv 1 -iv 0 -ov 255 \
    -cc "$(awk "BEGIN { print 1 - $refraction }")" "$dem" "$out/gdal.tif"
  if $with_grass; then measure "r.viewshed" bash -c "grass_viewshed '$dem' $x $y '$out/grass.tif'"; fi

  echo "  agreement with itin at every point, and time against the peers:"
  for t in "${tolerances[@]}"; do
    printf '  %-34s %s; %s x gdal_viewshed' "itin, tolerance $t m" \
      "$("$root/benchmarks/peers/agreement.py" "$out/itin-0.tif" "$out/itin-$t.tif")" \
      "$(ratio "itin, tolerance $t m" gdal_viewshed)"
    if $with_grass; then printf '; r.viewshed takes %s x' "$(ratio r.viewshed "itin, tolerance $t m")"; fi
    echo
  done
  local peer
  for peer in gdal grass; do
    if [ -f "$out/$peer.tif" ]; then
      printf '  %-34s %s\n' "$peer" "$("$root/benchmarks/peers/agreement.py" "$out/itin-0.tif" "$out/$peer.tif")"
    fi
  done
}

make_terrain
compare fractal 420485 6020485
if [ -f "$work/wales.tif" ]; then compare wales 310375 183525; fi
