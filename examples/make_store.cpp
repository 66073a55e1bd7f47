// Makes a store from a raster of heights and, where given, the footprints of buildings.
//
//   make_store town.itin scripts/demo-data/alexandria-dtm.tif scripts/demo-data/alexandria-buildings.geojson
#include <iostream>

#include <itin/itin.hpp>

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "make_store STORE.itin HEIGHTS.tif [BUILDINGS.geojson]\n";
    return 2;
  }
  try {
    itin::NoProgress progress;
    itin::ImportOptions terrain;
    terrain.sources = {argv[2]};
    const itin::ImportReport ground = itin::import_terrain(argv[1], terrain, progress);
    std::cout << ground.vertices << " vertices of terrain in " << ground.crs_name << '\n';

    if (argc > 3) {
      itin::ImportOptions buildings;
      buildings.sources = {argv[3]};
      buildings.kind = itin::ThemeKind::Buildings;
      buildings.theme = "buildings";
      buildings.height_field = "HEIGHT";
      std::cout << itin::import_lines(argv[1], buildings, progress).features << " buildings\n";
    }
  } catch (const itin::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
