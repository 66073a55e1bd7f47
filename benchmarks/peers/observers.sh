#!/bin/sh
# Many observers in one run, and single observers to compare with: Wales (build/peers/wales.itin, made by precise.sh),
# radius 40 km, cells of 50 m.
#
#   benchmarks/peers/observers.sh            with build/dev/bin/itin, or ITIN_PROGRAM
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
itin=${ITIN_PROGRAM:-$root/build/dev/bin/itin}
store=${ITIN_STORE:-$root/build/peers/wales.itin}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Masts of 100 m, spread over 40 km by 40 km; the same ones every time.
masts() {
  awk -v n="$1" 'BEGIN { srand(5); print "x,y,h"
    for (i = 0; i < n; ++i) printf "%.1f,%.1f,100\n", 270000 + 40000 * rand(), 250000 + 40000 * rand() }'
}

measure() {
  what=$1
  shift
  /usr/bin/time -f "$what: %U + %S s, %M kB" "$itin" viewshed "$store" --radius 40000 --cell 50 --nodata clear --quiet \
    --overwrite -o "$work/seen.tif" "$@" 2>&1 >"$work/text" | tail -1
}

masts 5 | tail -n +2 | while read -r mast; do
  for mode in visible height; do measure "one, $mode" --observer "$mast" --mode $mode; done
done
for count in 75 500; do
  masts $count >"$work/masts.csv"
  for mode in count which nearest height; do
    measure "$count, $mode" --observers "$work/masts.csv" --height-field h --mode $mode
  done
done
