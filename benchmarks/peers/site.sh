#!/usr/bin/env bash
# Ten sites out of 500 candidates in the valleys of South Wales (OS Terrain 50, 10 km radius, 50 m cells): whether the
# choice of itin site is that of brute force on 500 precise viewsheds, and whether a choice by Fresnel zones is the one
# that looks at every candidate exactly from the first. `benchmarks/peers/all --only sites` compares the times.
#   benchmarks/peers/site.sh
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"
require_tools python3

readonly out=$work/site/choices
readonly looks=(--radius 10000 --cell 50 --target-height 2)
"$root/benchmarks/peers/terrain.py" wales
if [ ! -f "$work/wales.itin" ]; then measure "itin import" "$itin" import --quiet "$work/wales.itin" "$work/wales.tif"; fi
rm -rf "$out"
mkdir -p "$out/precise"
"$root/benchmarks/peers/site_choice.py" candidates >"$out/candidates.csv"

measure "itin site, 10 of 500" "$itin" site "$work/wales.itin" --quiet --candidates "$out/candidates.csv" \
  --name-field name --mast-height 20 --count 10 --swap off --memory 4G "${looks[@]}" -o "$out/choice"

# A cell is served where the Fresnel zone is clear. Each frequency is run twice: as by default, and with every candidate
# exact from the first. The script says so where both choose the same sites.
for ghz in 5 0.45; do
  radio=(--frequency "$ghz" --effective-earth 4/3)
  measure "at $ghz GHz" "$itin" site "$work/wales.itin" --quiet --candidates "$out/candidates.csv" --name-field name \
    --mast-height 20 --count 10 --swap off --memory 4G "${looks[@]}" "${radio[@]}" -o "$out/choice-$ghz"
  measure "at $ghz GHz, all exact" "$itin" site "$work/wales.itin" --quiet --candidates "$out/candidates.csv" \
    --name-field name --mast-height 20 --count 10 --swap off --memory 4G "${looks[@]}" "${radio[@]}" --tolerance 0 \
    -o "$out/exact-$ghz"
  cmp <(cut -d, -f1-9 "$out/choice-$ghz/sites.csv") <(cut -d, -f1-9 "$out/exact-$ghz/sites.csv") &&
    echo "  the same sites and gains"
done

precise() {  # precise NAME X Y ...
  while [ $# -gt 0 ]; do
    "$itin" viewshed "$work/wales.itin" --quiet --precise --observer "$2,$3,20" "${looks[@]}" \
      -o "$out/precise/$1.tif" >/dev/null
    shift 3
  done
}
export -f precise
export itin work out
# shellcheck disable=SC2046
measure "500 precise viewsheds" bash -c 'looks=(--radius 10000 --cell 50 --target-height 2); precise "$@"' _ \
  $(awk -F, 'NR > 1 { print $1, $2, $3 }' "$out/candidates.csv")
"$root/benchmarks/peers/site_choice.py" compare "$out/candidates.csv" "$out/precise" "$out/choice/sites.csv"
