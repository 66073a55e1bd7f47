#!/usr/bin/env bash
# itin ztv against one viewshed per turbine by gdal_viewshed and GRASS r.viewshed: 75 turbines, 40 km, 50 m cells.
#   benchmarks/peers/ztv.sh              OS Terrain 50 of Wales
#   benchmarks/peers/ztv.sh NO_GRASS     without r.viewshed
# The peers run for SAMPLE turbines (default 5), spread over the farm, and their time is multiplied by 75 / SAMPLE, because
# each of their runs reads, computes and writes as much as any other. A peer's run tells visible from hidden at one height.
# itin writes its whole folder: tips and hubs, heights, angles and tables. Aims: at most a twentieth of the time of
# r.viewshed, and less than that of gdal_viewshed.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"
require_tools gdal_viewshed
with_grass=true
if [ "${1:-}" = NO_GRASS ] || ! command -v grass >/dev/null; then with_grass=false; fi

readonly turbines=75 radius=40000 tip=145 eye=2 refraction=0.13 sample=${SAMPLE:-5}
readonly out=$work/ztv
make_terrain
[ -f "$work/wales.tif" ] || { echo "$0: needs OS Terrain 50 of Wales in $data" >&2; exit 1; }
mkdir -p "$out"
rm -rf "${out:?}"/*
if [ ! -f "$work/wales.itin" ]; then measure "itin import" "$itin" import --quiet "$work/wales.itin" "$work/wales.tif"; fi

# A lattice about the middle of Wales, 500 m apart: Pumlumon and what lies east of it.
awk -v n=$turbines 'BEGIN {
  print "x,y,hub_height,rotor_diameter,farm"
  for (i = 0; i < n; ++i) printf "%d,%d,90,110,bench\n", 285025 + 500 * (i % 9), 280025 + 500 * int(i / 9)
}' >"$out/turbines.csv"

measure "itin ztv, $turbines turbines" "$itin" ztv "$work/wales.itin" --quiet --turbines "$out/turbines.csv" \
  --radius $radius --cell 50 --observer-height $eye --refraction $refraction -o "$out/itin"

sites() { awk -F, -v n=$turbines -v s="$sample" 'NR > 1 && (NR - 2) % int(n / s) == 0 && k++ < s { print $1, $2 }' "$out/turbines.csv"; }

gdal_runs() {
  local x y
  sites | while read -r x y; do
    gdal_viewshed -q -ox "$x" -oy "$y" -oz $tip -tz $eye -md $radius -vv 1 -iv 0 -ov 255 \
      -cc "$(awk "BEGIN { print 1 - $refraction }")" "$work/wales.tif" "$out/gdal-$x-$y.tif"
  done
}
grass_runs() {
  local script=$out/runs.sh x y
  {
    echo "set -e"
    echo "r.external --quiet input='$work/wales.tif' output=dem"
    echo "g.region raster=dem"
    sites | while read -r x y; do
      echo "r.viewshed -c -r -b --quiet input=dem output=seen coordinates=$x,$y observer_elevation=$tip" \
        "target_elevation=$eye max_distance=$radius refraction_coeff=$refraction memory=2000 --overwrite"
    done
  } >"$script"
  grass --tmp-location "$work/wales.tif" --exec bash "$script"
}
export -f gdal_runs grass_runs sites
export turbines radius tip eye refraction sample out work

against() {  # against NAME: the peer's time for all turbines, and the fraction of it that itin takes
  awk -v peer="${seconds[$1]}" -v itin="${seconds["itin ztv, $turbines turbines"]}" \
    -v peer_cpu="${processor[$1]}" -v itin_cpu="${processor["itin ztv, $turbines turbines"]}" -v n=$turbines -v s="$sample" \
    'BEGIN {
      printf "  %-34s %9.1f s for %d, multiplied; itin takes 1/%.1f of it\n", "", peer * n / s, n, peer * n / s / itin
      printf "  %-34s %9.1f s of processors; itin takes 1/%.1f of it\n", "", peer_cpu * n / s, peer_cpu * n / s / itin_cpu
    }'
}

measure "gdal_viewshed, $sample runs" bash -c gdal_runs
against "gdal_viewshed, $sample runs"
if $with_grass; then
  measure "r.viewshed, $sample runs" bash -c grass_runs
  against "r.viewshed, $sample runs"
fi
