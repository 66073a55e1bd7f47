#!/usr/bin/env bash
# A precise viewshed over posts 1 m apart that do not fit into memory: 5,000 million within 40 km.
#   benchmarks/peers/huge.sh [SIDE_KM [RADIUS_M [MEMORY]]]          80 40000 1G
# Makes a store of a fractal surface in build/peers, once (80 km: 3.9 GB, a quarter of an hour). Computes viewsheds of a
# mast of 30 m near its middle, with cells of 50 m: certified ones at coarse levels, then the precise one (6 minutes).
# Prints time and peak memory, which must stay below the budget. Last, compares the precise viewshed within 1 km computed
# sector by sector with the one computed at once.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"
require_tools
readonly side=${1:-80} radius=${2:-40000} memory=${3:-1G}
readonly store=$work/huge-$side.itin
if [ ! -f "$store" ]; then measure "writing $side km" "$(dirname "$itin")/itin_huge_store" "$store" "$side"; fi

# The highest post near the middle of 80 km; elsewhere the middle itself.
mast=$((400000 + side * 500)),$((6000000 + side * 500))
if [ "$side" = 80 ]; then mast=440032,6040372; fi
call=("$itin" viewshed "$store" --observer "$mast,30" --target-height 2 --precise --quiet --overwrite)
explore=("$itin" viewshed "$store" --observer "$mast,30" --target-height 2 --quiet --overwrite --radius "$radius" --cell 50)
for tolerance in 8 4; do
  measure "certified, $tolerance m" "${explore[@]}" --mode certified --tolerance "$tolerance" -o "$work/huge-certified.tif"
done
measure "precise, --memory $memory" "${call[@]}" --radius "$radius" --cell 50 --memory "$memory" -o "$work/huge.tif"
"${call[@]}" --radius 1000 --cell 5 --memory 8M -o "$work/huge-parts.tif" >/dev/null
"${call[@]}" --radius 1000 --cell 5 -o "$work/huge-whole.tif" >/dev/null
cmp "$work/huge-parts.tif" "$work/huge-whole.tif"
echo "  in sectors as at once: the same"
