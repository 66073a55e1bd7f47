#!/usr/bin/env bash
# Ten sites out of 500 candidates in the valleys of South Wales (OS Terrain 50, 10 km radius, 50 m cells). Compares the
# time of itin site with that of 500 precise viewsheds, and its choice with one made by brute force on these viewsheds.
#   benchmarks/peers/site.sh            all 500 precise viewsheds, and the comparison of the choices
#   benchmarks/peers/site.sh 50         only 50 precise viewsheds, and no comparison of the choices
# The aim: at most a tenth of the time of the viewsheds, and the sites of brute force.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"
require_tools python3

readonly timed=${1:-500} out=$work/site
readonly looks=(--radius 10000 --cell 50 --target-height 2)
make_terrain
[ -f "$work/wales.tif" ] || { echo "$0: needs OS Terrain 50 of Wales in $data" >&2; exit 1; }
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
measure "$timed precise viewsheds" bash -c 'looks=(--radius 10000 --cell 50 --target-height 2); precise "$@"' _ \
  $(awk -F, -v n="$timed" 'NR > 1 && NR <= n + 1 { print $1, $2, $3 }' "$out/candidates.csv")
awk -v a="${seconds[itin site, 10 of 500]}" -v b="${seconds[$timed precise viewsheds]}" -v n="$timed" \
  'BEGIN { printf "  itin site takes %.3f of the time of 500 precise viewsheds\n", a / (b * 500 / n) }'
if [ "$timed" -ge 500 ]; then
  "$root/benchmarks/peers/site_choice.py" compare "$out/candidates.csv" "$out/precise" "$out/choice/sites.csv"
fi
