#!/usr/bin/env bash
# What masts of 25 m serve of the premises within 500 m: 16 masts in Delft, and 50 in the town of 2,523 buildings, by
# sight and with a clear Fresnel zone at 26 GHz, and in less memory than the ground takes. Prints what the whole command
# costs, which draws a map, too, and what it costs to read the same ground alone and write it as triangles.
#   benchmarks/peers/premises.sh                 needs what delft.sh needs
#   EVERY=40 benchmarks/peers/premises.sh        compares every 40th building with brute force, too (1: all)
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"
source "$(dirname "${BASH_SOURCE[0]}")/town_stores.sh"

masts() { # masts TOWN COPIES COUNT
  "$peers/town.py" places "$delft" "$2" "$2" "$3" | awk -F, 'NR == 1 { print $0 ",height" } NR > 1 { print $0 ",25" }' \
    >"$work/$1/masts.csv"
}

served() { # served TOWN WHAT OPTION...
  local town=$1 what=$2
  shift 2
  measure "$what" "$itin" premises "$work/$town/$town.itin" --masts "$work/$town/masts.csv" --radius 500 --overwrite \
    --quiet -o "$work/$town/premises" "$@"
  jq -r '.premises | "    served: \(.served) of \(.all)"' "$work/$town/premises/premises.json"
}

brute_force() { # brute_force TOWN OUTLINES OPTION...
  local town=$1 outlines=$2
  shift 2
  [ -z "${EVERY:-}" ] || ITIN_PROGRAM=$itin "$root/tests/fuzz/premises.py" "$work/$town/$town.itin" "$outlines" \
    "$work/$town/masts.csv" --radius 500 --every "$EVERY" "$@"
}

masts delft 1 16
masts town 4 50
measure "Delft's ground with its themes" "$itin" tin "$work/delft/delft.itin" --all --themes all --overwrite --quiet \
  -o "$work/delft/all.ply"
served delft "Delft, 16 masts"
measure "the town's ground with its buildings" "$itin" tin "$work/town/town.itin" --all --themes all --overwrite \
  --quiet -o "$work/town/all.ply"
served town "the town, 50 masts"
served town "with a clear zone at 26 GHz" --frequency 26 --effective-earth 4/3
served town "in 64 MB" --memory 64M
served town "with poles that see the street" --setback 5
brute_force delft "$delft/output/testarea.json"
brute_force town "$work/town/footprints.geojson" --crs EPSG:28992

sited() { # sited TOWN WHAT COPIES CANDIDATES COUNT MEMORY: chooses sites for premises, compared with brute force
  local town=$1 what=$2 copies=$3 candidates=$4 count=$5 memory=$6
  local all=(--mast-height 12 --radius 250 --themes buildings --place-spacing 2 --overwrite --quiet)
  "$peers/town.py" places "$delft" "$copies" "$copies" "$candidates" >"$work/$town/candidates.csv"
  measure "$what" "$itin" site "$work/$town/$town.itin" --candidates "$work/$town/candidates.csv" --name-field name \
    --demand premises --count "$count" --swap off --cell 5 --memory "$memory" "${all[@]}" -o "$work/$town/sites"
  jq -r '.looks[] | "    needed no more than \(.at): \(.options_that_needed_no_more)"' "$work/$town/sites/site.json"
}

brute_force_choice() { # brute_force_choice TOWN
  local town=$1
  "$itin" premises "$work/$town/$town.itin" --masts "$work/$town/candidates.csv" --mast-height 12 --radius 250 \
    --themes buildings --spacing 2 --overwrite --quiet -o "$work/$town/premises" >/dev/null 2>&1
  "$peers/premises_choice.py" "$work/$town/candidates.csv" "$work/$town/premises/links.csv" "$work/$town/sites/sites.csv"
}

sited delft "Delft, 5 sites of 80" 1 80 5 1G
brute_force_choice delft
sited delft "in 150 MB" 1 80 5 150M
brute_force_choice delft
sited town "the town, 10 sites of 200" 4 200 10 1G
brute_force_choice town
sited town "in 60 MB" 4 200 10 60M
brute_force_choice town
