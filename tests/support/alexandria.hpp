// The bundled town, of lidar and footprints.
#pragma once

#include <string>

#include <itin/import.hpp>
#include <itin/progress.hpp>

namespace itin::test {

/// Imports the town's ground, and its buildings as the theme `buildings`.
inline void import_alexandria(const std::string& store) {
  const std::string data = std::string(ITIN_SOURCE_DIR) + "/scripts/demo-data/";
  NoProgress progress;
  ImportOptions terrain;
  terrain.sources = {data + "alexandria-dtm.tif"};
  import_terrain(store, terrain, progress);
  ImportOptions buildings;
  buildings.sources = {data + "alexandria-buildings.geojson"};
  buildings.kind = ThemeKind::Buildings;
  buildings.height_field = "HEIGHT";
  import_lines(store, buildings, progress);
}

}  // namespace itin::test
