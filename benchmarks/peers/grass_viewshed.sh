#!/usr/bin/env bash
# Viewsheds by GRASS r.viewshed, one after the other in one session; the last one is written to OUT.
#   benchmarks/peers/grass_viewshed.sh DEM EYE TARGET RADIUS REFRACTION OUT X,Y...         RADIUS 0: unlimited
set -euo pipefail
readonly dem=$1 eye=$2 target=$3 radius=$4 refraction=$5 out=$6
shift 6
reach=""
if [ "$radius" != 0 ]; then reach="max_distance=$radius"; fi
script=$(mktemp)
trap 'rm -f "$script"' EXIT
{
  echo "set -e"
  echo "r.external -o --quiet input='$dem' output=dem"
  echo "g.region raster=dem"
  for place in "$@"; do
    echo "r.viewshed -c -r -b --quiet --overwrite input=dem output=seen coordinates=$place observer_elevation=$eye" \
      "target_elevation=$target refraction_coeff=$refraction memory=4000 $reach"
  done
  echo "r.out.gdal --quiet --overwrite input=seen output='$out' type=Byte nodata=255"
} >"$script"
grass --tmp-location "$dem" --exec bash "$script"
