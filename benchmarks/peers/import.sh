#!/usr/bin/env bash
# itin import: posts per second, peak memory, and bytes per vertex. The latter are compared with an explicit TIN (36 bytes
# per vertex, indexed) and with the source as it came, a deflated GeoTIFF or LAS.
#   benchmarks/peers/import.sh [MEMORY]     default 2G
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/measure.sh"
require_tools gdalinfo
readonly memory=${1:-2G}

import() {  # import NAME SOURCE... [OPTION...]
  local name=$1 store=$work/$1.itin
  shift
  rm -f "$store"
  measure "$name" "$itin" import --quiet --memory "$memory" "$store" "$@"
  "$itin" info "$store" --json | /usr/bin/python3 -c "
import json, os, sys
info = json.load(sys.stdin)
vertices, stored = info['vertices'], info['bytes']
source = sum(os.path.getsize(path) for path in sys.argv[1:] if os.path.exists(path))
print(f'    {vertices:,} vertices, {vertices / ${seconds[$name]} / 1e6:.2f} million posts a second')
print(f'    {info[\"bytes_per_vertex\"]:.2f} bytes a vertex: 1/{36 * vertices / stored:.1f} of an explicit TIN, '
      f'{stored / source:.2f} times the source ({source / vertices:.2f} bytes a post)')
" "$@"
}

echo "import within --memory $memory"
make_terrain
import cardiff "$root/scripts/demo-data/cardiff.tif"
import fractal "$work/fractal.tif"
if [ -z "${NO_WALES:-}" ] && [ -f "$work/wales.tif" ]; then import wales "$work/wales.tif"; fi
readonly las=$data/derived-las
if [ -d "$las" ]; then
  import lidar-ground "$las/ign_0299_6802.las" "$las/ign_0300_6802.las" --class 2
  import lidar-all "$las/ign_0299_6802.las" "$las/ign_0300_6802.las"
  import lidar-town "$las/ahn3_cropped_2.las" --crs EPSG:28992
fi
