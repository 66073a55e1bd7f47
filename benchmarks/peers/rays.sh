#!/usr/bin/env bash
# Lines from 16 masts to places on walls and to cells of 2 m, decided exactly by rays, against Embree alone in single
# precision: over Alexandria (84 buildings), Delft (160 buildings, woods and walls) and lidar (519,000 points). Prints
# lines per second of one processor, their ratio, which is to be at least 0.55 for walls, 0.5 for cells of towns and 0.45
# over lidar, and what the scene costs to make for each triangle: 0.5 microseconds and 110 bytes at most.
#   benchmarks/peers/rays.sh
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"
source "$(dirname "${BASH_SOURCE[0]}")/town_stores.sh"
source "$(dirname "${BASH_SOURCE[0]}")/alexandria_store.sh"
require_tools jq

readonly benchmarks=$(dirname "$itin")/itin_benchmarks

compare() {  # compare NAME STORE
  ITIN_TOWN=$2 "$benchmarks" --benchmark_filter='Lines|SceneOfTown' --benchmark_format=json --benchmark_min_time=2 2>/dev/null |
    jq -r --arg name "$1" '
      [.benchmarks[] | {(.name): .}] | add |
      . as $all | ."BM_SceneOfTown/process_time" as $scene | "\($name): \($scene.triangles) triangles",
      (["walls", "cells"][] | . as $to | $all["BM_LinesByRays/" + $to] as $rays | select($rays.items_per_second) |
       ($rays.items_per_second / 1e6) as $exact | ($all["BM_LinesByEmbreeAlone/" + $to].items_per_second / 1e6) as $embree |
       "  \($to), \($rays.hidden * 100 | round) % hidden: \($exact * 100 | round / 100) million lines a second exactly, \($embree * 100 | round / 100) by Embree alone; ratio \($exact / $embree * 100 | round / 100)"),
      "  making the scene, for each triangle: \(1e8 / $scene.items_per_second | round / 100) microseconds, \($scene.bytes | round) bytes"'
}
compare Alexandria "$alexandria"
compare Delft "$work/delft/delft.itin"
lidar=$work/engines/lidar.itin
if [ ! -f "$lidar" ]; then "$itin" import "$lidar" "$data"/derived-las/ign_*.las --crs EPSG:2154 --quiet >/dev/null; fi
compare lidar "$lidar"
