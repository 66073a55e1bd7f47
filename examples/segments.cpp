// A viewshed decided piece by piece: stopped and continued, or by several runners on one folder.
//
//   segments town.itin 321800 4297750 work 2    decides two segments of the viewshed, and keeps them in the folder
//   segments town.itin 321800 4297750 work      decides what is left, and puts all together
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <limits>

#include <itin/itin.hpp>
#include <viewshed/plan.hpp>
#include <viewshed/result_files.hpp>

int main(int argc, char** argv) {
  if (argc != 5 && argc != 6) {
    std::cerr << "segments STORE.itin EASTING NORTHING FOLDER [COUNT]\n";
    return 2;
  }
  try {
    const itin::Store store(argv[1]);
    itin::NoProgress progress;
    itin::viewshed::Request request;
    request.observers = {{"observer", {std::atof(argv[2]), std::atof(argv[3])}, 2}};
    request.cell_size = 2;
    request.themes = itin::ThemeChoice::all();

    // Whoever makes the plan from these has the same segments.
    const itin::viewshed::Plan plan(store, request, {.memory_bytes = 64 << 20}, 40000);
    const std::filesystem::path folder = argv[4];
    std::filesystem::create_directories(folder);
    const auto path = [&](std::size_t i) { return (folder / std::to_string(i)).string(); };
    int left = argc == 6 ? std::atoi(argv[5]) : std::numeric_limits<int>::max();
    for (std::size_t i = 0; i < plan.segments().size() && left > 0; ++i) {
      if (std::filesystem::exists(path(i))) continue;
      itin::viewshed::write_segment(path(i), plan, i, itin::viewshed::decide(store, plan, i, progress));
      --left;
    }

    itin::viewshed::Merge merge(plan);
    for (std::size_t i = 0; i < plan.segments().size(); ++i)
      if (std::filesystem::exists(path(i))) merge.add(i, itin::viewshed::read_segment(path(i), plan, i));
    if (!merge.missing().empty()) {
      std::cout << merge.missing().size() << " of " << plan.segments().size() << " segments are left\n";
      return 0;
    }
    const itin::viewshed::Result result = merge.take();
    itin::viewshed::write_geotiff("segments.tif", result, {store.metadata().crs_wkt, {}, true});
    std::cout << result.cells.visible << " cells are visible, " << result.cells.hidden << " hidden\n";
  } catch (const itin::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
