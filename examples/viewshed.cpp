// What can be seen from a place: a viewshed as a GeoTIFF and as a map.
//
//   viewshed town.itin 321800 4297750
#include <cstdlib>
#include <iostream>

#include <itin/itin.hpp>
#include <viewshed/map_image.hpp>
#include <viewshed/result_files.hpp>
#include <viewshed/viewshed.hpp>

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "viewshed STORE.itin EASTING NORTHING\n";
    return 2;
  }
  try {
    const itin::Store store(argv[1]);
    itin::NoProgress progress;

    const itin::viewshed::Request request{
        .observers = {{"observer", {std::atof(argv[2]), std::atof(argv[3])}, 2}},  // 2 m above the ground
        .target_height = 1.5,
        .radius = 300,
        .cell_size = 1,
        .themes = itin::ThemeChoice::all(),  // buildings stand in the way
    };

    // Keeps the surface, which the map is drawn over.
    const itin::viewshed::ViewshedWithSurface computed =
        itin::viewshed::compute_with_surface(store, request, {}, progress);
    const itin::viewshed::Result& result = computed.result;
    for (const std::string& warning : result.warnings) std::cerr << warning << '\n';
    std::cout << result.cells.visible << " cells are visible, " << result.cells.hidden << " hidden\n";

    itin::viewshed::write_geotiff("viewshed.tif", result, {store.metadata().crs_wkt, {}, true});
    const auto map = itin::viewshed::draw_map(*computed.surface, result, progress, {.title = "From the street"});
    itin::viewshed::write_image("viewshed.png", map, true);
  } catch (const itin::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
