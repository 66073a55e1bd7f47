// A store has the lowest format that can hold what is in it, so that older programs read what they can.
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/store.hpp>

#include "support/raster_file.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin {
namespace {

class FormatVersion : public testing::Test {
 protected:
  FormatVersion() {
    test::write_raster(directory_.file("ground.tif"), {300000, 200000, 20, 20, 20, 27700}, [](int, int) { return 5; });
    test::write_lines(directory_.file("rows.geojson"), {test::box(300100, 199800, 300140, 199820, 7)});
  }

  int of(ThemeKind kind, bool raised, bool attributes) {
    const std::string path = directory_.file(std::to_string(++stores_) + ".itin");
    ImportOptions ground, rows;
    NoProgress progress;
    ground.sources = {directory_.file("ground.tif")};
    import_terrain(path, ground, progress);
    EXPECT_EQ(Store(path).metadata().format_version, 4);
    rows.sources = {directory_.file("rows.geojson")};
    rows.kind = kind;
    rows.theme = "rows";
    if (raised) rows.height_field = "h";
    if (!attributes) rows.attributes.emplace();
    rows.foundation = foundation_;
    import_lines(path, rows, progress);
    // Nothing is lost when it is written again.
    const int version = Store(path).metadata().format_version;
    import_terrain(path, ground, progress);
    EXPECT_EQ(Store(path).metadata().format_version, version);
    return version;
  }

  const test::TemporaryDirectory directory_;
  int stores_ = 0;
  std::optional<Foundation> foundation_;
};

TEST_F(FormatVersion, IsTheLowestThatHoldsTheStore) {
  EXPECT_EQ(of(ThemeKind::Roads, false, false), 4);
  EXPECT_EQ(of(ThemeKind::Buildings, true, false), 4);
  EXPECT_EQ(of(ThemeKind::Terraces, false, false), 5);
  EXPECT_EQ(of(ThemeKind::Terraces, true, false), 5);
  EXPECT_EQ(of(ThemeKind::Roads, false, true), 6);
  EXPECT_EQ(of(ThemeKind::Buildings, true, true), 6);
  EXPECT_EQ(of(ThemeKind::Terraces, true, true), 6);
}

/// A shed, which coarse levels leave out, on a foundation or not; and a hall, which none does.
TEST_F(FormatVersion, ThatOthersTookTellsOfFoundationsToo) {
  struct Case {
    double side;
    Foundation foundation;
    int version;
  };
  for (const Case& c : {Case{3, Foundation::flat, 9}, Case{3, Foundation::walls, 9}, Case{40, Foundation::flat, 8},
                        Case{40, Foundation::walls, 4}}) {
    test::write_lines(directory_.file("rows.geojson"), {test::box(300100, 199800, 300100 + c.side, 199820, 7)});
    foundation_ = c.foundation;
    EXPECT_EQ(of(ThemeKind::Buildings, true, false), c.version);
    const Store store(directory_.file(std::to_string(stores_) + ".itin"));
    EXPECT_EQ(store.metadata().has_foundations, c.foundation == Foundation::flat);
    EXPECT_EQ(store.metadata().parts.front().has_clusters, c.version == 9);
  }
}

}  // namespace
}  // namespace itin
