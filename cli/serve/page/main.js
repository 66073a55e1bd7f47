// The page of `itin serve`: puts its parts together.

import { askInfo } from "./server/api.js";
import { LiveConnection } from "./server/live_connection.js";
import { addressOf, readAddress } from "./state/address.js";
import { firstState } from "./state/first_state.js";
import { takeKey } from "./state/key.js";
import { Scene } from "./state/scene.js";
import { LiveViews } from "./seen/live_views.js";
import { shownOf } from "./seen/shown.js";
import { ContourLayer } from "./map/contour_layer.js";
import { HeightTiles } from "./map/height_tiles.js";
import { LineLayer } from "./map/line_layer.js";
import { makeMap, projectionOf } from "./map/map.js";
import { takeClicks } from "./map/map_clicks.js";
import { MastMarkers } from "./map/mast_markers.js";
import { makeReliefLayer } from "./map/relief_layer.js";
import { makeTargetMarker } from "./map/target_marker.js";
import { drawThemes } from "./map/theme_layer.js";
import { VerdictLayer } from "./map/verdict_layer.js";
import { makeLinePanel } from "./line/line_panel.js";
import { showStore } from "./panel/about.js";
import { element } from "./panel/elements.js";
import { makeHint } from "./panel/hint.js";
import { makeLayersForm } from "./panel/layers_form.js";
import { makeLegend } from "./panel/legend.js";
import { MastList } from "./panel/mast_list.js";
import { makeOptionsForm } from "./panel/options_form.js";
import { makePlaceForm } from "./panel/place_form.js";
import { Readout } from "./panel/readout.js";
import { makeResults } from "./panel/results.js";
import { makeSheet } from "./panel/sheet.js";
import { makeShowForm } from "./panel/show_form.js";
import { makeStatus } from "./panel/status.js";

/** Keeps the address true to the scene, some time after the last change. @param {Scene} scene */
function keepAddress(scene) {
  let waiting = 0;
  scene.on(["masts", "selected", "show", "target", "options", "layers", "view"], () => {
    clearTimeout(waiting);
    waiting = setTimeout(() => history.replaceState(null, "", `#${addressOf(scene.state)}`), 150);
  });
}

async function start() {
  const { key, rest } = takeKey();
  const info = await askInfo();
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const scene = new Scene(readAddress(rest, firstState(info)));
  const connection = new LiveConnection(key);
  // Before the map is made, which has the room that is left.
  element("line").hidden = !scene.farEnd;
  const views = new LiveViews(scene, connection);
  const tiles = new HeightTiles(info);
  const map = makeMap(element("map"), info, scene);
  const verdicts = new VerdictLayer();
  const lines = new LineLayer(scene);
  const projection = projectionOf(info);
  const showVerdicts = () => verdicts.show(shownOf(scene, views));

  showStore(info);
  map.addLayer(makeReliefLayer(info, scene, tiles, dark, projection));
  map.addLayer(new ContourLayer(scene, tiles, dark));
  map.addLayer(verdicts);
  drawThemes(map, info, scene);
  map.addLayer(lines);
  views.onChange(showVerdicts);
  scene.on(["show", "selected"], showVerdicts);

  const markers = new MastMarkers(map, scene);
  makeTargetMarker(map, scene);
  makeSheet();
  makeShowForm(scene);
  takeClicks(scene, map, (id) => markers.focus(id));
  makeHint(scene);
  makePlaceForm(scene, map);
  makeOptionsForm(scene, info, views);
  makeLayersForm(scene, info);
  makeLegend(scene, views);
  makeResults(scene, views, key);
  makeStatus(scene, connection, views);
  makeLinePanel(scene, connection, map, lines, dark);
  new MastList(scene, views, tiles);
  new Readout(scene, views, map, connection);
  keepAddress(scene);
  connection.connect();
}

start().catch((problem) => {
  element("status").hidden = false;
  element("status").classList.add("problem");
  element("status").textContent = `The map cannot start: ${problem.message}`;
});
