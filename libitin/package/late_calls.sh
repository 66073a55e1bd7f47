#!/bin/sh
# Writes the file that late_libraries.cpp includes: which functions of some shared libraries are called by some objects
# or static libraries.
#   late_calls.sh OUTPUT "OBJECT..." SHARED_LIBRARY...
set -eu
output=$1 objects=$2
shift 2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# shellcheck disable=SC2086
nm --undefined-only --no-sort -f posix $objects | awk 'NF > 1 { print $1 }' | sort -u >"$scratch/wanted"
for library in "$@"; do
  readelf --dynamic "$library" | sed -n 's/.*(SONAME).*\[\(.*\)\]/LATE_LIBRARY("\1")/p'
done >"$scratch/calls"
number=0
for library in "$@"; do
  nm --dynamic --defined-only -f posix "$library" | awk '$2 ~ /^[TW]$/ { sub("@.*", "", $1); print $1 }' | sort -u |
    comm -12 "$scratch/wanted" - | sed "s/.*/LATE_CALL($number, &)/"
  number=$((number + 1))
done >>"$scratch/calls"
mv "$scratch/calls" "$output"
