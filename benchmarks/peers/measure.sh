# Sourced by the scripts beside it: runs single commands under GNU time and remembers what they cost. measure.py runs
# commands in turns.

# measure NAME COMMAND...: sets seconds[NAME] (wall), processor[NAME] (seconds of all processors) and megabytes[NAME]
# (peak resident memory), and prints them.
declare -A seconds processor megabytes
measure() {
  local name=$1 figures
  shift
  figures=$(mktemp)
  if ! /usr/bin/time -f '%e %M %U %S' -o "$figures" "$@" >"$figures.log" 2>&1; then
    cat "$figures.log" >&2
    echo "$name failed: $*" >&2
    exit 1
  fi
  seconds["$name"]=$(awk '{ print $1 }' "$figures")
  megabytes["$name"]=$(awk '{ printf "%.0f", $2 / 1024 }' "$figures")
  processor["$name"]=$(awk '{ print $3 + $4 }' "$figures")
  rm -f "$figures" "$figures.log"
  printf '  %-34s %9.2f s %9.2f s of processors %7d MB\n' "$name" "${seconds[$name]}" "${processor[$name]}" \
    "${megabytes[$name]}"
}

# ratio A B: the time of A divided by that of B, by the clock. processor_ratio: by processor time, for a busy machine.
# memory_ratio: the peak memory.
quotient() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.2f", a / (b > 0 ? b : 0.01) }'; }
ratio() { quotient "${seconds[$1]}" "${seconds[$2]}"; }
processor_ratio() { quotient "${processor[$1]}" "${processor[$2]}"; }
memory_ratio() { quotient "${megabytes[$1]}" "${megabytes[$2]}"; }

require_tools() {
  local tool
  for tool in /usr/bin/time "$@"; do
    command -v "$tool" >/dev/null || { echo "$0: needs $tool (apt install time gdal-bin grass-core python3-gdal python3-numpy)" >&2; exit 1; }
  done
}

# The release build's program, and a folder for terrain, stores and results.
readonly root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
readonly itin=${ITIN_PROGRAM:-$root/build/release/bin/itin}
readonly data=${ITIN_DATA_DIR:-$root/../shared/data}
readonly work=${ITIN_BENCHMARK_DIR:-$root/build/peers}
mkdir -p "$work"
[ -x "$itin" ] || { echo "$0: build first: cmake --preset release && cmake --build --preset release" >&2; exit 1; }
