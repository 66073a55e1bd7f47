#!/usr/bin/env bash
# Cameras in towns: 5 of 80 places in Delft with its buildings, vegetation and walls, and 10 of 200 in a town of some
# 2,500 buildings, which are Delft's footprints 16 times over the demo's terrain. Each is sited twice: with the surface
# in memory, where every candidate is exact at once, and in less memory than the surface takes, where bounds by bins of
# it come first. Says how many candidates were surveyed again, and whether the choice is that of brute force on one
# precise viewshed for each candidate.
#   benchmarks/peers/town.sh            needs what delft.sh needs
#   NO_PRECISE=1 benchmarks/peers/town.sh     leaves out the precise viewsheds
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"
source "$(dirname "${BASH_SOURCE[0]}")/town_stores.sh"
"$peers/town.py" places "$delft" 1 1 80 >"$work/delft/places.csv"
"$peers/town.py" places "$delft" 4 4 200 >"$work/town/places.csv"

sited() {  # sited TOWN WHAT MEMORY OPTION...: the choice in $work/TOWN/MEMORY
  local town=$1 what=$2 memory=$3
  shift 3
  measure "$what" "$itin" site "$work/$town/$town.itin" --quiet --overwrite --candidates "$work/$town/places.csv" \
    --name-field name --mast-height 4 --swap off --target-height 1.5 --cell 2 --memory "$memory" "$@" \
    -o "$work/$town/$memory"
  jq -r '.looks[] | "    needed no more than \(.at): \(.options_that_needed_no_more)"' "$work/$town/$memory/site.json"
}

precise() {  # precise TOWN MEMORY RADIUS OPTION...: compares with the choices in the default memory and in that
  local town=$1 memory=$2 radius=$3 name x y
  shift 3
  rm -rf "$work/$town/precise"
  mkdir -p "$work/$town/precise"
  tail -n +2 "$work/$town/places.csv" | while IFS=, read -r name x y; do
    "$itin" viewshed "$work/$town/$town.itin" --quiet --precise --observer "$x,$y,4" --target-height 1.5 --cell 2 \
      --radius "$radius" --nodata clear "$@" -o "$work/$town/precise/$name.tif" >/dev/null 2>&1
  done
  for choice in 1G "$memory"; do
    "$peers/site_choice.py" compare "$work/$town/places.csv" "$work/$town/precise" "$work/$town/$choice/sites.csv"
  done
}

readonly all=(--themes buildings,vegetation,walls)
sited delft "Delft, 5 of 80" 1G --count 5 --radius 120 "${all[@]}"
sited delft "in 150 MB" 150M --count 5 --radius 120 "${all[@]}"
sited town "the town, 10 of 200" 1G --count 10 --radius 150
sited town "in 60 MB" 60M --count 10 --radius 150
if [ -z "${NO_PRECISE:-}" ]; then
  precise delft 150M 120 "${all[@]}"
  precise town 60M 150 --themes buildings
fi
