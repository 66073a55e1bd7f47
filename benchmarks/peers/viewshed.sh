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
export refraction

grass_viewshed() {  # grass_viewshed DEM X Y EYE TARGET OUT
  grass --tmp-location "$1" --exec bash -c "
    set -e
    r.in.gdal -o --quiet input='$1' output=dem
    g.region raster=dem
    r.viewshed -c -r -b --quiet input=dem output=seen coordinates=$2,$3 observer_elevation=$4 target_elevation=$5 \
      refraction_coeff=$refraction memory=4000
    r.out.gdal --quiet input=seen output='$6' type=Byte nodata=255 --overwrite"
}
export -f grass_viewshed

agreement() { "$root/benchmarks/peers/agreement.py" "$@"; }

compare() {  # compare NAME X Y EYE TARGET TOLERANCE...
  local name=$1 x=$2 y=$3 eye=$4 target=$5
  shift 5
  local tolerances=("$@") t dem=$work/$name.tif out=$work/$name-viewshed-$eye-$target
  echo "$name: observer $x,$y, $eye m up, targets $target m up"
  mkdir -p "$out"
  rm -f "$out"/*.tif
  if [ ! -f "$work/$name.itin" ]; then measure "itin import" "$itin" import --quiet "$work/$name.itin" "$dem"; fi
  local itin_call=("$itin" viewshed "$work/$name.itin" --quiet --observer "$x,$y,$eye" --target-height "$target"
                   --radius 1e6 --like "$dem")
  measure "itin, every point" "${itin_call[@]}" -o "$out/itin-0.tif"
  for t in "${tolerances[@]}"; do
    measure "itin, tolerance $t m" "${itin_call[@]}" --tolerance "$t" -o "$out/itin-$t.tif"
  done
  measure "gdal_viewshed" gdal_viewshed -q -ox "$x" -oy "$y" -oz "$eye" -tz "$target" -md 0 -vv 1 -iv 0 -ov 255 \
    -cc "$(awk "BEGIN { print 1 - $refraction }")" "$dem" "$out/gdal.tif"
  if $with_grass; then
    measure "r.viewshed" bash -c "grass_viewshed '$dem' $x $y $eye $target '$out/grass.tif'"
  fi

  echo "  agreement with itin at every point, and time against the peers:"
  for t in "${tolerances[@]}"; do
    printf '  %-34s %s; %s x gdal_viewshed' "itin, tolerance $t m" "$(agreement "$out/itin-0.tif" "$out/itin-$t.tif")" \
      "$(ratio "itin, tolerance $t m" gdal_viewshed)"
    if $with_grass; then printf '; r.viewshed takes %s x' "$(ratio r.viewshed "itin, tolerance $t m")"; fi
    echo
  done
  local peer
  for peer in gdal grass; do
    if [ -f "$out/$peer.tif" ]; then
      printf '  %-34s %s\n' "$peer" "$(agreement "$out/itin-0.tif" "$out/$peer.tif")"
    fi
  done
}

# A person who looks at the ground, and a mast that looks at other masts.
make_terrain
compare fractal 420485 6020485 2 0 0.5 1 2 4
compare fractal 420485 6020485 30 10 1 2 4 8
if [ -f "$work/wales.tif" ]; then
  compare wales 310375 183525 2 0 0.5 1 2 4
  compare wales 310375 183525 30 10 1 2 4 8
fi
