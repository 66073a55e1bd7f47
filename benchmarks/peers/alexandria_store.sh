# Sourced after measure.sh: makes $work/engines/town.itin where it is not there yet, 84 buildings of Alexandria on their
# ground.
mkdir -p "$work/engines"
readonly alexandria=$work/engines/town.itin
if [ ! -f "$alexandria" ]; then
  "$itin" import "$alexandria" "$root/scripts/demo-data/alexandria-dtm.tif" --quiet >/dev/null
  "$itin" import "$alexandria" "$root/scripts/demo-data/alexandria-buildings.geojson" --kind buildings \
    --height-field HEIGHT --quiet >/dev/null 2>&1
fi
