# Sourced after measure.sh. enter_cardiff NAME goes to the folder $work/NAME, where c.itin is the demo's terrain about
# Cardiff.
enter_cardiff() {
  mkdir -p "$work/$1"
  cd "$work/$1"
  [ -f c.itin ] || "$itin" import c.itin "$root/scripts/demo-data/cardiff.tif" --quiet >/dev/null
}
