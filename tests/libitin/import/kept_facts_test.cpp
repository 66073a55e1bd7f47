// A store says of what it holds what readers must know beforehand, and says so again after every later import.
#include <string>

#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/store.hpp>

#include "support/raster_file.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin {
namespace {

/// A shed, which coarse levels leave out, on a foundation or not; and a hall, which none does.
TEST(KeptFacts, TellOfFoundationsAndClusters) {
  const test::TemporaryDirectory directory;
  NoProgress progress;
  test::write_raster(directory.file("ground.tif"), {300000, 200000, 20, 20, 20, 27700}, [](int, int) { return 5; });
  ImportOptions ground, rows;
  ground.sources = {directory.file("ground.tif")};
  rows.sources = {directory.file("rows.geojson")};
  rows.kind = ThemeKind::Buildings;
  rows.theme = "rows";
  rows.height_field = "h";
  for (const double side : {3.0, 40.0}) {
    for (const Foundation foundation : {Foundation::flat, Foundation::walls}) {
      const std::string path = directory.file(std::to_string(side) + std::to_string(static_cast<int>(foundation)));
      test::write_lines(rows.sources[0], {test::box(300100, 199800, 300100 + side, 199820, 7)});
      rows.foundation = foundation;
      import_terrain(path, ground, progress);
      import_lines(path, rows, progress);
      for (int again = 0; again < 2; ++again) {
        const Store store(path);
        EXPECT_EQ(store.metadata().has_foundations, foundation == Foundation::flat);
        EXPECT_EQ(store.metadata().parts.front().has_clusters, side == 3.0);
        if (again == 0) import_terrain(path, ground, progress);
      }
    }
  }
}

}  // namespace
}  // namespace itin
