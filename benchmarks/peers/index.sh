#!/usr/bin/env bash
# How much is seen from everywhere, by rays: 4 million posts 50 m apart, a square of 100 km in mid Wales.
# Prints how far shares are off at places 20 km within, and how many of them the stated error covers; what the index of
# the whole square costs, with an observer at each post; and what a look takes with each set of instructions, which have
# to give the same bytes. The truth of a place is a viewshed of cells of 13 m, which the sweep decides.
# Cells of 10 or 25 m would not do: many of their centres lie on edges between posts, and more of them are seen.
#   benchmarks/peers/index.sh [PLACES]          # 40 places, if it is not told otherwise
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"
require_tools gdal_translate gdallocationinfo jq

readonly places=${1:-40} folder=$work/index
mkdir -p "$folder"
"$root/benchmarks/peers/terrain.py" wales
cd "$folder"
if [ ! -f mid.itin ]; then
  gdal_translate -q -projwin 250000 300000 350000 200000 "$work/wales.tif" mid.tif
  "$itin" import mid.itin mid.tif --quiet >/dev/null
fi

# The centres of some cells of 2,050 m, which are posts; the same ones every time.
awk -v n="$places" 'BEGIN { srand(1994)
  for (i = 0; i < n; ++i) print 1025 + 2050 * (132 + int(28 * rand())), 1025 + 2050 * (108 + int(28 * rand())) }' >places.txt

truth() {  # truth RADIUS: what is seen from each place, as shares, in truth-RADIUS.txt, which is kept
  local x y
  [ "$(wc -l <"truth-$1.txt" 2>/dev/null)" = "$places" ] || while read -r x y; do
    "$itin" viewshed mid.itin --observer "$x,$y,2" --target-height 0 --radius "$1" --cell 13 -o seen.tif --overwrite \
      --quiet --json | jq -r '.cells | .visible / (.visible + .hidden)'
  done <places.txt >"truth-$1.txt"
}

compare() {  # compare RADIUS rays|targets NUMBER
  "$itin" visibility mid.itin --bbox 270000,221000,329000,280000 --cell 2050 --radius "$1" "--$2" "$3" -o index.tif \
    --overwrite --quiet >/dev/null
  gdallocationinfo -valonly -geoloc index.tif <places.txt | grep . | paste - - - | paste - "truth-$1.txt" |
    awk -v km="$(($1 / 1000))" -v by="$3 $2" '
      { off = $1 < $4 ? $4 - $1 : $1 - $4; mean += $4; squared += off * off; stated += $2 * $2
        once += off <= $2; twice += off <= 2 * $2 }
      END { mean /= NR; printf "  %2d km, %11s: %.2f %% is seen; off by %4.1f %% of that, %4.1f %% stated; ", km, by,
              100 * mean, 100 * sqrt(squared / NR) / mean, 100 * sqrt(stated / NR) / mean
            printf "%.1f %% of places are off by no more than stated, %.1f %% by no more than twice that\n",
              100 * once / NR, 100 * twice / NR }'
}

echo "shares at $places places against viewsheds"
for radius in 5000 20000; do
  truth "$radius"
  for rays in 32 64 128 256; do compare "$radius" rays "$rays"; done
  compare "$radius" targets 128
done

echo "4 million observers, 20 km, 128 rays"
measure "rays" "$itin" visibility mid.itin --all --cell 50 --radius 20000 --rays 128 -o whole.tif --overwrite --quiet

"$(dirname "$itin")/itin_benchmarks" --benchmark_filter=BM_RaysOfAnIndex
