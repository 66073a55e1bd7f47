#!/usr/bin/env bash
# A tile of 200 x 200 posts that comes to stores of growing size, beside their ground, against the import of the same
# rasters into a new store. Prints the time by the clock, the processor time and the peak memory of both, and their ratios.
# Real terrain of Wales where it is present, otherwise a fractal. Both stores have to have the same digest.
#   benchmarks/peers/adding_terrain.sh [POSTS_ALONG_THE_SIDE...]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"
require_tools gdal_translate gdalinfo

readonly folder=$work/adding-terrain tile=200
mkdir -p "$folder"
if "$root/benchmarks/peers/terrain.py" wales 2>/dev/null; then
  terrain=$work/wales.tif first_column=2000 first_row=3000 sides=(500 1000 2000)
else
  terrain=$folder/fractal.tif first_column=0 first_row=0 sides=(500 1000 2000 3800)
  [ -f "$terrain" ] || "$root/benchmarks/peers/fractal.py" "$terrain" 4096
fi
[ $# -eq 0 ] || sides=("$@")

cut_out() { gdal_translate -q -srcwin "$1" "$2" "$3" "$4" "$terrain" "$5"; }  # cut_out COLUMN ROW COLUMNS ROWS OUT
digest() { "$itin" info "$1" --digest --json | sed -n 's/.*"digest": *"\([0-9a-f]*\)".*/\1/p'; }

cd "$folder"
for side in "${sides[@]}"; do
  echo "$terrain, $side x $side posts"
  cut_out "$first_column" "$first_row" "$side" "$side" base.tif
  cut_out $((first_column + side)) $((first_row + side / 2)) "$tile" "$tile" tile.tif
  rm -f base.itin anew.itin
  "$itin" import --quiet base.itin base.tif >/dev/null
  measure "both anew, $side" "$itin" import --quiet anew.itin base.tif tile.tif
  measure "the tile comes, $side" "$itin" import --quiet base.itin tile.tif
  [ "$(digest base.itin)" = "$(digest anew.itin)" ] || { echo "the two stores are not equal" >&2; exit 1; }
  echo "  adding against anew: $(ratio "the tile comes, $side" "both anew, $side") of the time," \
    "$(processor_ratio "the tile comes, $side" "both anew, $side") of the processor time," \
    "$(memory_ratio "the tile comes, $side" "both anew, $side") of the memory"
done
