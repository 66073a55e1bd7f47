#!/bin/sh
# Prints what late_gdal.cpp includes: which functions of the shared library $2 the static library $1 calls.
set -eu
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
readelf --dynamic "$2" | sed -n 's/.*(SONAME).*\[\(.*\)\]/static const char* const kGdal = "\1";/p'
nm --undefined-only --no-sort -f posix "$1" | awk 'NF > 1 { print $1 }' | sort -u >"$scratch/wanted"
nm --dynamic --defined-only -f posix "$2" | awk '$2 ~ /^[TW]$/ { sub("@.*", "", $1); print $1 }' | sort -u >"$scratch/offered"
comm -12 "$scratch/wanted" "$scratch/offered" | sed 's/.*/LATE_CALL(&)/'
