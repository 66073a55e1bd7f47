#!/usr/bin/env bash
# Jobs of many tasks: one runner of one thread, two of them at the same time, and the call by itself with two threads.
# Prints for each the time by the clock, the processor time and the peak memory, those of the merge as well, and how many
# times as fast two runners are as one, which is to be 1.9 on two idle cores. The outputs have to have the same bytes.
# With matplotlib, draws time against workers in build/peers/jobs/workers.svg (job_workers.py).
#   benchmarks/peers/jobs.sh
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"
source "$(dirname "${BASH_SOURCE[0]}")/cardiff_folder.sh"

enter_cardiff jobs
awk 'BEGIN { print "x,y,height"; for (i = 0; i < 400; i++) print 303000 + 1700 * (i % 20) "," 173500 + 1700 * int(i / 20) ",20" }' \
  >masts.csv

two_runners() {  # two_runners JOB
  "$itin" job run "$1" --threads 1 --quiet >/dev/null &
  "$itin" job run "$1" --threads 1 --quiet >/dev/null
  wait
}
export -f two_runners
export itin

count=0
compare() {  # compare NAME OUTPUT VERB ARGUMENT...: its output is in OUTPUT, a file or a folder
  local name=$1 out=$2 job=jobs/$((++count))
  echo "$name"
  shift 2
  rm -rf "$job" two out alone
  mkdir -p jobs out
  "$itin" job plan "$job" --tasks 40 "$@" -o "out/$out" >/dev/null 2>&1
  "$itin" job plan two --tasks 40 "$@" -o "out/$out" >/dev/null 2>&1
  measure alone "$itin" "$@" -o "out/$out" --threads 2 --quiet
  mv out alone
  mkdir out
  measure one "$itin" job run "$job" --threads 1 --quiet
  measure two bash -c "two_runners two"
  measure merge "$itin" job merge two --threads 2 --quiet
  diff -r alone out
  printf '{"name": "%s", "job": "%s", "alone": %s, "one": %s, "two": %s, "merge": %s}\n' "$name" "$job" \
    "${seconds[alone]}" "${seconds[one]}" "${seconds[two]}" "${seconds[merge]}" >>figures.jsonl
  printf '  two runners: %s times as fast as one\n' "$(ratio one two)"
  printf '  two runners / the call by itself: %s by the clock, %s of processors\n' "$(ratio two alone)" \
    "$(processor_ratio two alone)"
}

rm -f figures.jsonl
compare "how much is seen from 10,000 places, 40 million lines" out.tif visibility c.itin --bbox 305000,180000,315000,190000 \
  --cell 100 --radius 10000 --targets 4096
compare "what 400 masts see, 1.6 million cells" out.tif viewshed c.itin --observers masts.csv --mode count --radius 15000 \
  --cell 25
compare "the best 10 of 400 sites, cells of 25 m" sites site c.itin --candidates masts.csv --count 10 --radius 15000 --cell 25 \
  --memory 2G
compare "the same, 0.6 of the Fresnel zone clear at 5 GHz" sites site c.itin --candidates masts.csv --count 10 --radius 10000 \
  --cell 50 --memory 2G --frequency 5
if python3 -c 'import matplotlib' 2>/dev/null; then
  "$root/benchmarks/peers/job_workers.py" figures.jsonl workers.svg
else
  echo "no picture: python3-matplotlib is not installed"
fi
