#!/usr/bin/env bash
# Certified and precise viewsheds against gdal_viewshed on the same grid: time, peak memory, share decided.
#   benchmarks/peers/certified.sh            the bundled Cardiff sample, the synthetic fractal, OS Terrain 50 of Wales
#   benchmarks/peers/certified.sh CARDIFF    the sample alone
# Both aims concern one observer and targets 2 m up: certified at a tolerance that decides 95 % no slower than
# gdal_viewshed, precise at most four times as slow.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"
require_tools gdal_viewshed

readonly eye=2 target=2 refraction=0.13
readonly tolerances=(0.5 1 2 4 8)

decided() { sed -n 's/.*(\([0-9.]*\) % decided).*/\1/p' "$1"; }

compare() {  # compare NAME DEM X Y
  local name=$1 dem=$2 x=$3 y=$4 out=$work/$1-certified t
  echo "$name: observer $x,$y, $eye m up, targets $target m up"
  mkdir -p "$out"
  rm -f "$out"/*.tif
  if [ ! -f "$work/$name.itin" ]; then measure "itin import" "$itin" import --quiet "$work/$name.itin" "$dem"; fi
  local call=("$itin" viewshed "$work/$name.itin" --quiet --observer "$x,$y,$eye" --target-height $target --like "$dem")
  measure "gdal_viewshed" gdal_viewshed -q -ox "$x" -oy "$y" -oz $eye -tz $target -md 0 -vv 1 -iv 0 -ov 255 \
    -cc "$(awk "BEGIN { print 1 - $refraction }")" "$dem" "$out/gdal.tif"
  for t in "${tolerances[@]}"; do
    measure "itin certified, $t m" bash -c '"$@" >"$0"' "$out/$t.txt" "${call[@]}" --mode certified --tolerance "$t" -o "$out/$t.tif"
    printf '  %-34s %9s %% decided; %s x gdal_viewshed\n' "" "$(decided "$out/$t.txt")" \
      "$(ratio "itin certified, $t m" gdal_viewshed)"
  done
  measure "itin precise" "${call[@]}" --precise -o "$out/precise.tif"
  printf '  %-34s %9s x gdal_viewshed\n' "" "$(ratio "itin precise" gdal_viewshed)"
}

compare cardiff "$root/scripts/demo-data/cardiff.tif" 310375 183525
if [ "${1:-}" = CARDIFF ]; then exit; fi
make_terrain
compare fractal "$work/fractal.tif" 420485 6020485
if [ -f "$work/wales.tif" ]; then compare wales "$work/wales.tif" 310375 183525; fi
