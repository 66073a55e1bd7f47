// Outlines for maps, against the footprints that were imported.
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include <itin/building_outlines.hpp>
#include <itin/import.hpp>

#include "support/houses.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin {
namespace {

class BuildingOutlines : public testing::Test {
 protected:
  void SetUp() override {
    test::write_raster(directory_.file("flat.tif"), {300000, 200000, 20, 40, 40, 27700}, [](int, int) { return 50.0; });
    ImportOptions terrain;
    terrain.sources = {directory_.file("flat.tif")};
    import_terrain(store_, terrain, progress_);
    const auto metres = [&](int most) { return static_cast<double>(random_() % static_cast<unsigned>(most)); };
    for (int i = 0; i < 300; ++i) {
      const int column = i % 20, row = i / 20;
      const double x = 300050 + 34 * column + metres(5), y = 199250 + 46 * row + metres(5);
      footprints_.push_back({x, y, x + 1 + metres(26), y + 1 + metres(36)});
    }
    import("houses", ThemeKind::Buildings, footprints_);
    import("woods", ThemeKind::Vegetation, {{ 300015, 199215, 300040, 199240 }});
  }

  void import(const std::string& theme, ThemeKind kind, const std::vector<Box>& boxes) {
    std::vector<test::LineFeature> features;
    for (const Box& b : boxes) features.push_back(test::box(b.xmin, b.ymin, b.xmax, b.ymax, 8));
    test::import_raised(store_, directory_.file(theme + ".geojson"), kind, theme, features);
  }

  std::vector<Box> boxes_of(const ThemeChoice& themes, const Box& box, const OutlineDetail& detail) {
    std::vector<Box> boxes;
    for (const std::vector<Point2>& ring : building_outlines(Store(store_), themes, box, detail)) {
      EXPECT_EQ(ring.front().x, ring.back().x);
      EXPECT_EQ(ring.front().y, ring.back().y);
      EXPECT_EQ(ring.size(), 5U);
      boxes.emplace_back();
      for (const Point2& p : ring) boxes.back().extend(p);
    }
    return boxes;
  }

  /// Both in the order of their numbers.
  static void expect_same(const std::vector<Box>& found, const std::vector<Box>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i].xmin, expected[i].xmin, 0.01);
      EXPECT_NEAR(found[i].ymin, expected[i].ymin, 0.01);
      EXPECT_NEAR(found[i].xmax, expected[i].xmax, 0.01);
      EXPECT_NEAR(found[i].ymax, expected[i].ymax, 0.01);
    }
  }

  std::mt19937 random_{test::seed()};
  test::TemporaryDirectory directory_;
  std::string store_ = directory_.file("s.itin");
  std::vector<Box> footprints_;
  NoProgress progress_;
};

TEST_F(BuildingOutlines, AreThoseOfEveryFootprintOfAChosenThemeOfBuildings) {
  const Box all{299000, 198000, 302000, 201000};
  expect_same(boxes_of(ThemeChoice::all(), all, {}), footprints_);
  expect_same(boxes_of(ThemeChoice::parse("houses"), all, {0.5, 0}), footprints_);
  EXPECT_TRUE(boxes_of(ThemeChoice::parse("woods"), all, {}).empty());
  EXPECT_TRUE(boxes_of(ThemeChoice::none(), all, {}).empty());
}

TEST_F(BuildingOutlines, AreThoseOfTerracesToo) {
  const Box row{300015, 199260, 300045, 199268};
  import("rows", ThemeKind::Terraces, {row});
  expect_same(boxes_of(ThemeChoice::parse("rows"), row, {}), {row});
}

TEST_F(BuildingOutlines, LeavesOutWhatLiesElsewhereOrIsSmaller) {
  const Box part{300200, 199400, 300420, 199600};
  std::vector<Box> expected;
  std::copy_if(footprints_.begin(), footprints_.end(), std::back_inserter(expected),
               [&](const Box& b) { return part.meets(b) && (b.width() >= 12 || b.height() >= 12); });
  ASSERT_FALSE(expected.empty());
  ASSERT_LT(expected.size(), footprints_.size());
  expect_same(boxes_of(ThemeChoice::all(), part, {0.1, 12}), expected);
}

TEST_F(BuildingOutlines, TellOneBuildingFromAnother) {
  const std::vector<BuildingFoot> feet =
      building_feet(Store(store_), ThemeChoice::all(), {299000, 198000, 302000, 201000});
  ASSERT_EQ(feet.size(), footprints_.size());
  for (std::size_t i = 0; i < feet.size(); ++i) {
    EXPECT_EQ(feet[i].feature, static_cast<std::int64_t>(i));
    EXPECT_EQ(Store(store_).metadata().themes[feet[i].theme - std::size_t{1}].name, "houses");
    ASSERT_EQ(feet[i].rings.size(), 1U);
    EXPECT_EQ(feet[i].rings.front().front(), feet[i].rings.front().back());
    Box box;
    for (const Point2& p : feet[i].rings.front()) box.extend(p);
    expect_same({box}, {footprints_[i]});
  }
  const Box part{300200, 199400, 300420, 199600};
  const auto meeting =
      std::count_if(footprints_.begin(), footprints_.end(), [&](const Box& b) { return part.meets(b); });
  EXPECT_EQ(building_feet(Store(store_), ThemeChoice::all(), part).size(), static_cast<std::size_t>(meeting));
}

TEST_F(BuildingOutlines, AreNotThoseOfBuildingsThatTheImportLeftOut) {
  // The terrain ends at 300800 in the east; two buildings lie beyond it, and one reaches over its border.
  const std::vector<Box> boxes{{300900, 199400, 300920, 199420},
                               {300950, 199400, 300970, 199420},
                               {300740, 199900, 300760, 199920},
                               {300790, 199400, 300820, 199420}};
  import("far", ThemeKind::Buildings, boxes);
  const Box all{299000, 198000, 302000, 201000};
  expect_same(boxes_of(ThemeChoice::parse("far"), all, {}), {boxes[2]});
  const Store store(store_);
  const auto far = std::find_if(store.metadata().themes.begin(), store.metadata().themes.end(),
                                [](const ThemeInfo& theme) { return theme.name == "far"; });
  EXPECT_EQ(far->left_out, (std::vector<FeatureRun>{{0, 1}, {3, 3}}));
  EXPECT_EQ(far->left_out_count(), 3U);
  EXPECT_EQ(far->features, 1U);
  const std::vector<BuildingFoot> feet = building_feet(store, ThemeChoice::parse("far"), all);
  ASSERT_EQ(feet.size(), 1U);
  EXPECT_EQ(feet[0].feature, 2);
}

TEST_F(BuildingOutlines, ReturnWhereTheGroundHasCome) {
  const Box beyond{300900, 199400, 300920, 199420};
  import("far", ThemeKind::Buildings, {beyond});
  EXPECT_TRUE(boxes_of(ThemeChoice::parse("far"), beyond, {}).empty());
  test::write_raster(directory_.file("east.tif"), {300800, 200000, 20, 40, 40, 27700}, [](int, int) { return 50.0; });
  ImportOptions terrain;
  terrain.sources = {directory_.file("east.tif")};
  import_terrain(store_, terrain, progress_);
  expect_same(boxes_of(ThemeChoice::parse("far"), beyond, {}), {beyond});
  for (const ThemeInfo& theme : Store(store_).metadata().themes) EXPECT_TRUE(theme.left_out.empty()) << theme.name;
}

}  // namespace
}  // namespace itin
