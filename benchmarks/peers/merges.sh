#!/usr/bin/env bash
# What the merge of a job takes of memory, against the size of the raster: of what 70 masts see, of which of them see it, of
# what is seen of 200 turbines, and of how much is seen from everywhere, in cells of several sizes. Prints for each the
# number of cells, how many megabytes their values are, time and peak memory of the merge, and the same of the call by
# itself where cells are of 10 m and more. The outputs have to have the same bytes.
#   benchmarks/peers/merges.sh [CELL...]      metres; 40, 20, 10 and 5 where none are given
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"
source "$(dirname "${BASH_SOURCE[0]}")/cardiff_folder.sh"
require_tools gdalinfo

enter_cardiff merges
awk 'BEGIN { print "x,y,height"; for (i = 0; i < 70; i++) print 303000 + 3400 * (i % 10) "," 173500 + 4800 * int(i / 10) ",20" }' \
  >masts.csv
awk 'BEGIN { print "x,y,hub_height,rotor_diameter"
             for (i = 0; i < 200; i++) print 306000 + 1400 * (i % 20) "," 178000 + 2500 * int(i / 20) ",90,110" }' >turbines.csv

compare() {  # compare NAME BYTES_OF_A_CELL RASTER CELL VERB ARGUMENT...: RASTER is the output, or in the output's folder
  local name=$1 bytes=$2 raster=$3 cell=$4 cells
  shift 4
  rm -rf job out alone
  mkdir out
  "$itin" job plan job --tasks 100 "$@" --cell "$cell" -o "out/${raster%%/*}" >/dev/null 2>&1
  "$itin" job run job --quiet >/dev/null 2>&1
  measure merge "$itin" job merge job --quiet
  cells=$(gdalinfo "out/$raster" | awk -F '[ ,]+' '/^Size is/ { print $3 * $4 }')
  awk -v what="$name, cells of $cell m" -v n="$cells" -v b="$bytes" \
    'BEGIN { printf "%s: %.2f million cells, %.0f MB of values\n", what, n / 1e6, n * b / 2^20 }'
  [ "$cell" -ge 10 ] || return 0
  mv out alone
  mkdir out
  measure alone "$itin" "$@" --cell "$cell" -o "out/${raster%%/*}" --quiet
  diff -r alone out
}
cells=("$@")
[ $# -gt 0 ] || cells=(40 20 10 5)
for cell in "${cells[@]}"; do
  compare "what 70 masts see" 1 seen.tif "$cell" viewshed c.itin --observers masts.csv --radius 6000
  compare "which of 70 masts see it" 13 seen.tif "$cell" viewshed c.itin --observers masts.csv --mode which --radius 6000
  compare "what is seen of 200 turbines" 64 zone/tip-count.tif "$cell" ztv c.itin --turbines turbines.csv --radius 6000
  compare "how much is seen" 12 seen.tif "$cell" visibility c.itin --bbox 303000,173000,335000,205000 --radius 500 --targets 8
done
