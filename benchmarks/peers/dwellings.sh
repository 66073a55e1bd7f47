#!/usr/bin/env bash
# What 75 turbines are to 100 dwellings: shadow flicker by every minute of a year. The turbines stand 500 m apart in the
# hills about Cardiff, the dwellings among them. Prints what the whole command costs.
#   benchmarks/peers/dwellings.sh                needs the release build
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"
require_tools jq

mkdir -p "$work/dwellings"
cd "$work/dwellings"
[ -e cardiff.itin ] || "$itin" import cardiff.itin "$root/scripts/demo-data/cardiff.tif" --quiet >/dev/null
awk 'BEGIN { print "x,y,hub_height,rotor_diameter"
  for (row = 0; row < 5; ++row) for (column = 0; column < 15; ++column) print 308000 + 500 * column "," 186000 + 500 * row ",100,120" }' \
  >turbines.csv
awk 'BEGIN { srand(1); print "x,y"; for (i = 0; i < 100; ++i) printf "%.1f,%.1f\n", 307500 + 8000 * rand(), 185500 + 3000 * rand() }' \
  >dwellings.csv
measure "100 dwellings x 75 turbines x a year" "$itin" dwellings cardiff.itin --turbines turbines.csv \
  --dwellings dwellings.csv --year 2027 --overwrite --quiet -o out "$@"
jq -r '.dwellings | "    with flicker: \(.with_flicker) of \(.all), more than 30 hours: \(.over_year)"' out/dwellings.json
