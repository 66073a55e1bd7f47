// The page of `itin serve`: puts its parts together.

import { Jobs, askInfo } from "./server/api.js";
import { LiveConnection } from "./server/live_connection.js";
import { addressOf, readAddress } from "./state/address.js";
import { firstState } from "./state/first_state.js";
import { followNewKeys, takeKey } from "./state/key.js";
import { Scene } from "./state/scene.js";
import { LiveViews } from "./seen/live_views.js";
import { shownOf } from "./seen/shown.js";
import { ContourLayer } from "./map/contour_layer.js";
import { HeightTiles } from "./map/height_tiles.js";
import { LineLayer } from "./map/line_layer.js";
import { makeMap, projectionOf, showWhole } from "./map/map.js";
import { takeClicks } from "./map/map_clicks.js";
import { makeReliefLayer } from "./map/relief_layer.js";
import { PremisesLayer } from "./map/premises_layer.js";
import { SearchLayer } from "./map/search_layer.js";
import { makeMastMarkers, makeSiteMarkers, makeTurbineMarkers } from "./map/task_markers.js";
import { makeViewpointMarker } from "./map/viewpoint_marker.js";
import { makeTargetMarker } from "./map/target_marker.js";
import { drawThemes } from "./map/theme_layer.js";
import { VerdictLayer } from "./map/verdict_layer.js";
import { makeLinePanel } from "./line/line_panel.js";
import { showStore } from "./panel/about.js";
import { element } from "./panel/elements.js";
import { makeHint } from "./panel/hint.js";
import { makeInside } from "./panel/inside.js";
import { makeLayersForm } from "./panel/layers_form.js";
import { makeLegend } from "./panel/legend.js";
import { MastList } from "./panel/mast_list.js";
import { makeOptionsForm } from "./panel/options_form.js";
import { makePlaceForm } from "./panel/place_form.js";
import { Readout } from "./panel/readout.js";
import { makeResults } from "./panel/results.js";
import { makeSheet } from "./panel/sheet.js";
import { makeShowForm } from "./panel/show_form.js";
import { makeUndo } from "./panel/undo.js";
import { makeUndecided } from "./panel/undecided.js";
import { makeStatus } from "./panel/status.js";
import { makeDwellingsSurvey } from "./plan/dwellings_survey.js";
import { recall } from "./plan/recall.js";
import { makePremisesSurvey } from "./plan/premises_survey.js";
import { makeSearchForm } from "./plan/search_form.js";
import { makeServedForm } from "./plan/served_form.js";
import { makeSiteChoice } from "./plan/site_choice.js";
import { makeReliefPanel } from "./relief/relief_panel.js";
import { makeTasksForm, takeDrops } from "./plan/tasks_form.js";
import { makeTurbinePanel } from "./plan/turbine_panel.js";
import { makeWireline, makeZoneFiles } from "./plan/zone_files.js";

/** Keeps the address true to the scene, some time after the last change. @param {Scene} scene */
function keepAddress(scene) {
  let waiting = 0;
  const kept = /** @type {(keyof import("./state/scene.js").SceneState)[]} */ ([
    ...["task", "masts", "selected", "show", "target", "options", "layers", "view"],
    ...["turbines", "part", "viewpoint", "search", "served", "siting", "plan"],
  ]);
  scene.on(kept, () => {
    clearTimeout(waiting);
    waiting = setTimeout(() => history.replaceState(null, "", `#${addressOf(scene.state)}`), 150);
  });
}

/** What the server writes for the planner.
 * @param {{scene: Scene, views: LiveViews, map: import("./vendor/ol.js").OlMap, info: import("./server/api.js").Info,
 *   jobs: Jobs}} world @param {import("./plan/recall.js").Gone} gone */
function makePlans({ scene, views, map, info, jobs }, gone) {
  makeResults(scene, views, jobs);
  const layout = makeTurbinePanel(scene, views, jobs, map);
  makeZoneFiles(scene, jobs);
  makeWireline(scene, jobs, map);
  const places = makeSearchForm(scene, map, jobs, info, gone.search);
  makeServedForm(scene, map, jobs, info, gone.served);
  takeDrops(scene, { layout, places });
  makeSiteChoice({ scene, views, map, info, jobs }, gone.plan);
  makePremisesSurvey(scene, jobs);
  makeDwellingsSurvey(scene, jobs, info);
}

async function start() {
  const { key, rest } = takeKey();
  const info = await askInfo();
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const { state, gone } = await recall(rest, readAddress(rest, firstState(info)));
  const scene = new Scene(state);
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
  map.addLayer(new SearchLayer(scene));
  map.addLayer(new PremisesLayer(scene));
  map.addLayer(lines);
  views.onChange((come) => verdicts.show(shownOf(scene, views), come));
  scene.on(["show", "selected", "task", "part", "plan"], showVerdicts);

  const masts = makeMastMarkers(map, scene);
  const turbines = makeTurbineMarkers(map, scene);
  makeSiteMarkers(map, scene);
  makeTargetMarker(map, scene);
  makeViewpointMarker(map, scene);
  makeSheet(scene, views, map);
  makeTasksForm(scene, info);
  makeShowForm(scene);
  takeClicks(scene, map, masts, turbines);
  makeHint(scene);
  makePlaceForm(scene, map);
  makeOptionsForm(scene, info, views);
  makeLayersForm(scene, info);
  makeLegend(scene, views);
  makeUndecided(scene, views);
  makeInside(scene, views);
  makeUndo(scene);
  element("whole-map").addEventListener("click", () => showWhole(map, info));
  makeStatus(connection, views, tiles);
  makeLinePanel(scene, connection, map, lines, dark);
  new MastList(scene, views, tiles);
  new Readout(scene, views, map, connection, info);
  makeReliefPanel({ scene, views, map, info });
  makePlans({ scene, views, map, info, jobs: new Jobs(key) }, gone);
  keepAddress(scene);
  followNewKeys(() => addressOf(scene.state));
  connection.connect();
}

start().catch((problem) => {
  element("status").hidden = false;
  element("status").classList.add("problem");
  element("status").textContent = `The map cannot start: ${problem.message}`;
});
