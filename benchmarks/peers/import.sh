#!/usr/bin/env bash
# itin import: posts a second, peak memory, and bytes a vertex against an explicit TIN (36 bytes a vertex, indexed) and
# against the source as a deflated GeoTIFF.
#   benchmarks/peers/import.sh [MEMORY]     default 2G
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"
require_tools gdalinfo
readonly memory=${1:-2G}

import() {  # import NAME
  local name=$1 dem=$work/$1.tif store=$work/$1.itin
  rm -f "$store"
  measure "$name" "$itin" import --quiet --memory "$memory" "$store" "$dem"
  "$itin" info "$store" --json | /usr/bin/python3 -c "
import json, os, sys
info = json.load(sys.stdin)
vertices, stored, source = info['vertices'], info['bytes'], os.path.getsize('$dem')
print(f'    {vertices:,} vertices, {vertices / ${seconds[$name]} / 1e6:.2f} million posts a second')
print(f'    {info[\"bytes_per_vertex\"]:.2f} bytes a vertex: 1/{36 * vertices / stored:.1f} of an explicit TIN, '
      f'{stored / source:.2f} times the source ({source / vertices:.2f} bytes a post)')
"
}

echo "import within --memory $memory"
make_terrain
import fractal
if [ -f "$work/wales.tif" ]; then import wales; fi
