#!/usr/bin/env bash
# Many observers in one run, and single observers to compare with: Wales, radius 40 km, cells of 50 m.
#   benchmarks/peers/observers.sh
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"
require_tools
readonly out=$work/observers
mkdir -p "$out"
"$root/benchmarks/peers/terrain.py" wales
if [ ! -f "$work/wales.itin" ]; then measure "itin import" "$itin" import --quiet "$work/wales.itin" "$work/wales.tif"; fi

# Masts of 100 m, spread over 40 km by 40 km; the same ones every time.
masts() {
  awk -v n="$1" 'BEGIN { srand(5); print "x,y,h"
    for (i = 0; i < n; ++i) printf "%.1f,%.1f,100\n", 270000 + 40000 * rand(), 250000 + 40000 * rand() }'
}

seen() {  # seen NAME OPTION...
  local name=$1
  shift
  measure "$name" "$itin" viewshed "$work/wales.itin" --radius 40000 --cell 50 --nodata clear --quiet --overwrite \
    -o "$out/seen.tif" "$@"
}

for mast in $(masts 5 | tail -n +2); do
  for mode in visible height; do seen "one, $mode" --observer "$mast" --mode $mode; done
done
for count in 75 500; do
  masts $count >"$out/masts-$count.csv"
  for mode in count which nearest height; do
    seen "$count, $mode" --observers "$out/masts-$count.csv" --height-field h --mode $mode
  done
done
