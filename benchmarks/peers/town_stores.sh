# Sourced after measure.sh: makes the stores of two towns where they are not there yet. $work/delft/delft.itin is Delft with
# all its themes; $work/town/town.itin has some 2,500 buildings, which are Delft's footprints 16 times over the demo's
# terrain, from $work/town/footprints.geojson.
require_tools python3 gdal_translate jq

readonly peers=$root/benchmarks/peers delft=$data/ahn3-bgt-delft
[ -f "$work/delft/delft.itin" ] || ITIN_PROGRAM=$itin "$peers/delft.sh" "$work/delft"

mkdir -p "$work/town"
if [ ! -f "$work/town/town.itin" ]; then
  gdal_translate -q -a_srs EPSG:28992 -a_ullr 0 1036 1132 0 "$root/scripts/demo-data/alexandria-dtm.tif" \
    "$work/town/ground.tif"
  "$peers/town.py" footprints "$delft" 4 4 >"$work/town/footprints.geojson"
  measure "import of the town's ground" "$itin" import --quiet "$work/town/town.itin" "$work/town/ground.tif"
  measure "and of its 2,560 buildings" "$itin" import --quiet "$work/town/town.itin" "$work/town/footprints.geojson" \
    --kind buildings --height-field h --crs EPSG:28992
fi
