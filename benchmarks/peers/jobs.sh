#!/usr/bin/env bash
# Jobs of many tasks: one runner of one thread, two of them at the same time, and the call by itself with two threads.
# Prints for each the time by the clock, the processor time and the peak memory, and how many times as fast two runners
# are as one, which is to be 1.9 on two idle cores. The outputs have to have the same bytes.
#   benchmarks/peers/jobs.sh
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"

readonly folder=$work/jobs terrain=$root/scripts/demo-data/cardiff.tif
mkdir -p "$folder"
cd "$folder"
[ -f c.itin ] || "$itin" import c.itin "$terrain" --quiet >/dev/null
awk 'BEGIN { print "x,y,height"; for (i = 0; i < 400; i++) print 303000 + 1700 * (i % 20) "," 173500 + 1700 * int(i / 20) ",20" }' \
  >masts.csv

two_runners() {  # two_runners JOB
  "$itin" job run "$1" --threads 1 --quiet >/dev/null &
  "$itin" job run "$1" --threads 1 --quiet >/dev/null
  wait
}
export -f two_runners
export itin

compare() {  # compare NAME VERB ARGUMENT...: its output is out.tif
  echo "$1"
  shift
  rm -rf one two out.*
  "$itin" job plan one --tasks 40 "$@" -o out.tif >/dev/null
  "$itin" job plan two --tasks 40 "$@" -o out.tif >/dev/null
  measure alone "$itin" "$@" -o out.tif --threads 2 --quiet --overwrite
  mv out.tif alone.tif
  rm out.qml
  measure one "$itin" job run one --threads 1 --quiet
  measure two bash -c "two_runners two"
  "$itin" job merge two --quiet >/dev/null 2>&1
  cmp alone.tif out.tif
  printf '  two runners: %s times as fast as one\n' "$(ratio one two)"
  printf '  two runners / the call by itself: %s by the clock, %s of processors\n' "$(ratio two alone)" \
    "$(processor_ratio two alone)"
}

compare "how much is seen from 10,000 places, 40 million lines" visibility c.itin --bbox 305000,180000,315000,190000 \
  --cell 100 --radius 10000 --targets 4096
compare "what 400 masts see, 1.6 million cells" viewshed c.itin --observers masts.csv --mode count --radius 15000 --cell 25
