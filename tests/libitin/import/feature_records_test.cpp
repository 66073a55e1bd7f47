// What a store says of features: their ids, names and attributes, and which of them stands where.
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <itin/feature_at.hpp>

#include "libitin/import/feature_imports.hpp"
#include "support/sound_store.hpp"

namespace itin::test {
namespace {

class FeatureRecords : public FeatureImports {};

TEST_F(FeatureRecords, ComeWithAttributesOrWithNone) {
  write_lines(path("lanes.geojson"), wandering("lane", 3));
  import("hill.itin", ground());
  ImportOptions lanes = options("lanes.geojson", ThemeKind::Roads, "lanes");
  lanes.name_field = "ref";
  import("hill.itin", lanes);
  {
    const Store store(path("hill.itin"));
    EXPECT_EQ(store.metadata().themes[0].fields,
              (std::vector<AttributeField>{
                  {"ref", AttributeType::text}, {"rank", AttributeType::whole}, {"length", AttributeType::number}}));
    FeatureTable table(store, 1);
    ASSERT_NE(table.at(2), nullptr);
    EXPECT_EQ(table.at(2)->name, "lane2");
    EXPECT_EQ(table.at(2)->values[1], AttributeValue(std::int64_t{2}));
    EXPECT_EQ(table.at(3), nullptr);
    EXPECT_EQ(table.at(-1), nullptr);
  }
  // A field that holds texts elsewhere holds texts, and one more field comes last.
  LineFeature other{{{300200, 199200, 0}, {300300, 199300, 0}}};
  other.properties = R"({"rank":"high","owner":"council"})";
  write_lines(path("paths.geojson"), {other});
  ImportOptions paths = options("paths.geojson", ThemeKind::Roads, "lanes");
  paths.id_field.clear();
  import("hill.itin", paths);
  const Store store(path("hill.itin"));
  EXPECT_EQ(store.metadata().themes[0].fields[1].type, AttributeType::text);
  EXPECT_EQ(store.metadata().themes[0].fields[3].name, "owner");
  FeatureTable table(store, 1);
  EXPECT_EQ(table.at(3)->id, "0");
  EXPECT_EQ(table.at(3)->values[3], AttributeValue(std::string("council")));
  EXPECT_EQ(table.at(2)->values[1], AttributeValue(std::int64_t{2}));
  expect_sound(store);

  import("bare.itin", ground());
  lanes.id_field.clear(), lanes.name_field.clear();
  lanes.attributes.emplace();
  import("bare.itin", lanes);
  const Store bare(path("bare.itin"));
  EXPECT_EQ(bare.metadata().themes[0].feature_blocks, 0U);
  const Edges unnamed = edges_of(bare, Window::all(), Detail::tolerance(0));
  EXPECT_FALSE(unnamed.empty());
  for (const IdentifiedEdge& e : unnamed) EXPECT_EQ(e.id, "");
}

TEST_F(FeatureRecords, AreToldOfWhatStands) {
  LineFeature hall = box(300200, 199200, 300240, 199220, 12);
  hall.properties = R"({"h":12,"ref":"42","label":"Town Hall"})";
  write_lines(path("hall.geojson"), {box(300300, 199200, 300340, 199220, 5), hall});
  import("town.itin", ground());
  ImportOptions houses = raised("hall.geojson", "houses");
  houses.name_field = "label";
  import("town.itin", houses);
  const Store store(path("town.itin"));
  const auto found = features_at(store, 1, {{300210, 199210}, {300310, 199210}, {300100, 199100}});
  ASSERT_TRUE(found[0]);
  EXPECT_EQ(title_of(*found[0]), "Town Hall (id 42)");
  const auto numbered = features_numbered(store, 1, {1, 7, -1});
  ASSERT_TRUE(numbered[0]);
  EXPECT_EQ(numbered[0]->id, "42");
  EXPECT_FALSE(numbered[1]);
  EXPECT_FALSE(numbered[2]);
  EXPECT_EQ(title_of({3, "feature 7", "7"}), "feature 7");
  EXPECT_EQ(title_of({3, "Barn", ""}), "Barn");
  EXPECT_EQ(title_of({3, "NL.7", "NL.7"}), "NL.7");
}

TEST_F(FeatureRecords, OfMeasuredRoofsComeWithTheirOutlineTogether) {
  // Two halves of one roof, and no footprint.
  std::ofstream(path("barn.json")) << R"({"type":"CityJSON","version":"2.0",
    "metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/27700"},
    "CityObjects":{"barn":{"type":"Building","attributes":{"use":"hay"},"geometry":[{"type":"MultiSurface","lod":"2",
      "boundaries":[[[0,1,4,5]],[[5,4,2,3]]],
      "semantics":{"surfaces":[{"type":"RoofSurface"}],"values":[0,0]}}]}},
    "vertices":[[300200,199200,120],[300230,199200,120],[300230,199220,120],[300200,199220,120],
                [300230,199210,126],[300200,199210,126]]})";
  import("farm.itin", ground());
  ImportOptions barn = options("barn.json", ThemeKind::Buildings, "barns");
  barn.id_field.clear();
  import("farm.itin", barn);
  const Store store(path("farm.itin"));
  double length = 0;
  for (const IdentifiedEdge& e : edges_of(store, Window::all(), Detail::tolerance(0))) {
    EXPECT_EQ(e.id, "barn");
    length += std::hypot(e.b.x - e.a.x, e.b.y - e.a.y) * store.metadata().grid.resolution;
  }
  EXPECT_NEAR(length, 100, 0.05);
  EXPECT_EQ(records_of(store).at({"barns", "barn"}).second.at("use"), AttributeValue(std::string("hay")));
}

}  // namespace
}  // namespace itin::test
