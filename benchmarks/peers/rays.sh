#!/usr/bin/env bash
# Lines from 16 masts to places on walls, decided exactly by rays, against Embree alone in single precision: over
# Alexandria (84 buildings) and Delft (160 buildings, woods and walls). Prints lines per second of one processor, their
# ratio, which is to be 0.55 at least, and what the scene costs to make for each triangle: 0.5 microseconds and 110 bytes
# at most.
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
      [.benchmarks[] | {(.name | split("/")[0]): .}] | add |
      (.BM_LinesByRays.items_per_second / 1e6) as $rays | (.BM_LinesByEmbreeAlone.items_per_second / 1e6) as $embree |
      "\($name): \(.BM_SceneOfTown.triangles) triangles, \(.BM_LinesByRays.hidden * 100 | round) % of lines hidden",
      "  million lines a second: \($rays * 100 | round / 100) exactly, \($embree * 100 | round / 100) by Embree alone; ratio \($rays / $embree * 100 | round / 100)",
      "  making the scene, for each triangle: \(1e8 / .BM_SceneOfTown.items_per_second | round / 100) microseconds, \(.BM_SceneOfTown.bytes | round) bytes"'
}
compare Alexandria "$alexandria"
compare Delft "$work/delft/delft.itin"
