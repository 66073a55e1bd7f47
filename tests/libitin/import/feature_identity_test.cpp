// A line in a store is its feature's, at every level and in every window, whatever was imported when.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <itin/feature_at.hpp>
#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/tin_export.hpp>
#include <itin/triangulate.hpp>

#include "features/feature_lines.hpp"
#include "store/feature_table.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/sound_store.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin {
namespace {

using test::LineFeature;

/// A piece of a line: the theme's name, the feature's id, and both ends with their heights, the lesser first.
struct IdentifiedEdge {
  std::string theme, id;
  GridPoint a, b;
  friend auto operator<=>(const IdentifiedEdge&, const IdentifiedEdge&) = default;
};
using Edges = std::set<IdentifiedEdge>;

std::vector<std::uint16_t> all_themes(const Store& store) {
  std::vector<std::uint16_t> themes;
  for (std::size_t t = 1; t <= store.metadata().themes.size(); ++t) themes.push_back(static_cast<std::uint16_t>(t));
  return themes;
}

Edges edges_of(const Store& store, const Window& window, const Detail& detail) {
  NoProgress progress;
  const Tin tin = triangulate(store, window, detail, progress, ThemeChoice::all().with_ground_lines());
  Edges edges;
  for (const FeatureLine& line : feature_lines(store, {tin, window, detail, all_themes(store)}, progress)) {
    FeatureTable table(store, line.theme);
    const FeatureRecord* record = line.feature ? table.at(*line.feature) : nullptr;
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      const auto [a, b] = std::minmax(
          {store.metadata().grid.quantise(line.points[i - 1]), store.metadata().grid.quantise(line.points[i])});
      edges.insert(
          {store.metadata().themes[line.theme - std::size_t{1}].name, record != nullptr ? record->id : "", a, b});
    }
  }
  return edges;
}

/// What a store says of features, by theme and id: names, and values by field.
using Records =
    std::map<std::pair<std::string, std::string>, std::pair<std::string, std::map<std::string, AttributeValue>>>;

Records records_of(const Store& store) {
  Records records;
  for (const std::uint16_t theme : all_themes(store)) {
    const ThemeFeatures features = stored_features(store, theme);
    for (const FeatureRecord& record : features.records) {
      auto& [name, values] = records[{store.metadata().themes[theme - std::size_t{1}].name, record.id}];
      name = record.name;
      for (std::size_t i = 0; i < record.values.size(); ++i) values[features.fields[i].name] = record.values[i];
    }
  }
  return records;
}

/// In doubles, which are exact for what they clip but for the very last bits.
bool meets_box(const GridBox& box, const GridPoint& a, const GridPoint& b) {
  double from = 0, to = 1;
  const auto clip = [&](double start, double step, double low, double high) {
    if (step == 0) return low <= start && start <= high;
    const auto [near, far] = std::minmax({(low - start) / step, (high - start) / step});
    from = std::max(from, near), to = std::min(to, far);
    return from <= to;
  };
  return clip(a.x, double{1} * b.x - a.x, box.xmin, box.xmax) && clip(a.y, double{1} * b.y - a.y, box.ymin, box.ymax);
}

double distance_to(const std::vector<Point3>& line, Point3 p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Point3 &a = line[i - 1], &b = line[i];
    const double dx = b.x - a.x, dy = b.y - a.y;
    const double t = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
    least = std::min(least, std::hypot(a.x + t * dx - p.x, a.y + t * dy - p.y));
  }
  return least;
}

class FeatureIdentity : public testing::Test {
 protected:
  FeatureIdentity() {
    test::write_raster(path("ground.tif"), {300000, 200000, 20, 50, 50, 27700}, [](int c, int r) {
      return 100 + 20 * std::sin(c / 7.0) + 15 * std::cos(r / 5.0) + 2 * std::sin(c * 1.7 + r * 2.3);
    });
  }

  std::string path(const std::string& name) const { return directory_.file(name); }
  double in(double low, double high) { return low + (high - low) * static_cast<double>(random_() % 1000000) / 1e6; }

  /// Lines that cross each other; every third goes on where the one before it ends, and every fifth repeats it.
  std::vector<LineFeature> wandering(const std::string& prefix, int count) {
    std::vector<LineFeature> features;
    for (int i = 0; i < count; ++i) {
      LineFeature f;
      f.properties = fmt::format(R"({{"ref":"{}{}","rank":{},"length":{:.2f}}})", prefix, i, i, in(0, 9));
      const bool goes_on = i % 3 == 2;
      Point3 p =
          goes_on ? features.back().vertices.back() : Point3{in(300100, 300800), in(199100, 199900), in(80, 130)};
      double heading = in(0, 6.28);
      for (int k = 0; k < 12; ++k) {
        f.vertices.push_back(p);
        // Near the edge of the ground lines turn back to its middle.
        const bool near_edge = std::max(std::abs(p.x - 300500), std::abs(p.y - 199500)) > 430;
        heading = near_edge ? std::atan2(199500 - p.y, 300500 - p.x) : heading + in(-0.5, 0.5);
        p = {p.x + 15 * std::cos(heading), p.y + 15 * std::sin(heading), p.z + in(-1, 1)};
      }
      if (i % 5 == 4) f.vertices = features.back().vertices;
      features.push_back(f);
      lines_[prefix + std::to_string(i)] = f.vertices;
    }
    return features;
  }

  std::vector<LineFeature> houses(int count) {
    std::vector<LineFeature> features;
    for (int i = 0; i < count; ++i) {
      const double x = in(300100, 300850), y = in(199100, 199850);
      features.push_back(test::box(x, y, x + in(5, 30), y + in(5, 30), 8));
      features.back().properties = fmt::format(R"({{"h":8,"ref":"house{}"}})", i);
    }
    return features;
  }

  ImportOptions raised(const std::string& file, const std::string& theme) const {
    ImportOptions houses = options(file, ThemeKind::Buildings, theme);
    houses.height_field = "h";
    return houses;
  }

  ImportOptions options(const std::string& file, ThemeKind kind, const std::string& theme) const {
    ImportOptions options;
    options.sources = {path(file)};
    options.kind = kind;
    options.theme = theme;
    options.id_field = "ref";
    return options;
  }

  ImportOptions ground() const {
    ImportOptions options;
    options.sources = {path("ground.tif")};
    return options;
  }

  void import(const std::string& store, const ImportOptions& options) {
    NoProgress progress;
    if (options.kind)
      import_lines(path(store), options, progress);
    else
      import_terrain(path(store), options, progress);
  }

  test::TemporaryDirectory directory_;
  std::mt19937 random_{test::seed()};
  std::map<std::string, std::vector<Point3>> lines_;  ///< as imported, by id
};

/// In the plane, for steps of 1 cm: where lines were led through crossings, and where their vertices are rounded.
constexpr double kRoundedBy = 0.015;

TEST_F(FeatureIdentity, HoldsAtEveryLevel) {
  test::write_lines(path("ridges.geojson"), wandering("ridge", 16));
  test::write_lines(path("lanes.geojson"), wandering("lane", 16));
  import("hill.itin", ground());
  import("hill.itin", options("ridges.geojson", ThemeKind::Breaklines, "ridges"));
  import("hill.itin", options("lanes.geojson", ThemeKind::Roads, "lanes"));
  const Store store(path("hill.itin"));
  const Grid& grid = store.metadata().grid;
  for (const LevelInfo& level : store.metadata().levels) {
    const Edges edges = edges_of(store, Window::all(), Detail::tolerance(level.tolerance));
    std::map<std::string, std::vector<const IdentifiedEdge*>> by_id;
    for (const IdentifiedEdge& e : edges) by_id[e.id].push_back(&e);
    EXPECT_EQ(by_id.size(), lines_.size()) << level.tolerance;
    for (const auto& [id, line] : lines_) {
      ASSERT_TRUE(by_id.contains(id)) << id << " at " << level.tolerance;
      const double tolerance = kRoundedBy + (id.starts_with("ridge") ? level.lateral_tolerance : 0);
      std::vector<std::vector<Point3>> pieces;
      for (const IdentifiedEdge* e : by_id.at(id)) {
        pieces.push_back({grid.point(e->a), grid.point(e->b)});
        for (const Point3& p : pieces.back()) EXPECT_LE(distance_to(line, p), tolerance) << id;
      }
      // Nothing of the whole line is missing, its ends least of all.
      for (const Point3& p : line) {
        double least = tolerance + 1;
        for (const auto& piece : pieces) least = std::min(least, distance_to(piece, p));
        EXPECT_LE(least, &p == &line.front() || &p == &line.back() ? kRoundedBy : tolerance)
            << id << " at " << level.tolerance;
      }
    }
    // At full detail an edge is of each feature whose line it lies on, and of no other.
    if (level.tolerance > 0) continue;
    for (const IdentifiedEdge& e : edges) {
      const Point3 a = grid.point(e.a), b = grid.point(e.b), middle{(a.x + b.x) / 2, (a.y + b.y) / 2, 0};
      for (const auto& [id, line] : lines_) {
        const bool along = distance_to(line, a) < kRoundedBy && distance_to(line, middle) < kRoundedBy / 2 &&
                           distance_to(line, b) < kRoundedBy;
        if (std::hypot(b.x - a.x, b.y - a.y) < 1 || id.substr(0, 4) != e.id.substr(0, 4)) continue;
        EXPECT_EQ(edges.contains({e.theme, id, e.a, e.b}), along) << id << " beside " << e.id;
      }
    }
  }
  test::expect_sound(store);
}

TEST_F(FeatureIdentity, IsThatOfTheWholeInEveryWindow) {
  test::write_lines(path("ridges.geojson"), wandering("ridge", 16));
  test::write_lines(path("houses.geojson"), houses(30));
  import("hill.itin", ground());
  import("hill.itin", options("ridges.geojson", ThemeKind::Breaklines, "ridges"));
  import("hill.itin", raised("houses.geojson", "houses"));
  const Store store(path("hill.itin"));
  const Grid& grid = store.metadata().grid;
  for (const double tolerance : {0.0, 1.0, 8.0}) {
    const Detail detail = Detail::tolerance(tolerance);
    const Edges whole = edges_of(store, Window::all(), detail);
    ASSERT_TRUE(std::any_of(whole.begin(), whole.end(), [](const auto& e) { return e.id.starts_with("house"); }));
    for (int round = 0; round < 12; ++round) {
      const double x = in(300050, 300900), y = in(199050, 199900), side = in(5, 300);
      const GridPoint low = grid.quantise({x, y, 0}), high = grid.quantise({x + side, y + side, 0});
      const GridBox box{low.x, low.y, high.x, high.y};
      Edges expected;
      for (const IdentifiedEdge& e : whole)
        if (meets_box(box, e.a, e.b)) expected.insert(e);
      EXPECT_EQ(edges_of(store, Window::box(grid.box(box)), detail) == expected, true)
          << tolerance << " m in " << side << " m at " << x << "," << y;
    }
  }
}

TEST_F(FeatureIdentity, KnowsNoOrderOfImport) {
  test::write_lines(path("ridges.geojson"), wandering("ridge", 10));
  test::write_lines(path("edges.geojson"), wandering("edge", 6));
  test::write_lines(path("lanes.geojson"), wandering("lane", 10));
  test::write_lines(path("houses.geojson"), houses(20));
  test::write_raster(path("survey.tif"), {300300, 199700, 5, 60, 60, 27700},
                     [](int c, int r) { return 110 + 3 * std::sin(c / 3.0) + 2 * std::cos(r / 4.0); });
  ImportOptions survey = ground();
  survey.sources = {path("survey.tif")};
  survey.replace = true;
  std::vector<ImportOptions> sources{options("ridges.geojson", ThemeKind::Breaklines, "ridges"),
                                     options("edges.geojson", ThemeKind::Breaklines, "ridges"),
                                     options("lanes.geojson", ThemeKind::Roads, "lanes"),
                                     raised("houses.geojson", "houses"), survey};
  import("first.itin", ground());
  for (const ImportOptions& source : sources) import("first.itin", source);
  const Store first(path("first.itin"));
  EXPECT_EQ(records_of(first).size(), 46U);
  for (int round = 0; round < 3; ++round) {
    std::shuffle(sources.begin(), sources.end(), random_);
    const std::string name = fmt::format("other{}.itin", round);
    import(name, ground());
    for (const ImportOptions& source : sources) import(name, source);
    const Store other(path(name));
    EXPECT_EQ(records_of(first) == records_of(other), true) << round;
    for (const double tolerance : {0.0, 2.0}) {
      const Detail detail = Detail::tolerance(tolerance);
      EXPECT_EQ(edges_of(first, Window::all(), detail) == edges_of(other, Window::all(), detail), true)
          << tolerance << " m, round " << round;
    }
    test::expect_sound(other);
  }
}

TEST_F(FeatureIdentity, ComesWithAttributesOrWithNone) {
  test::write_lines(path("lanes.geojson"), wandering("lane", 3));
  import("hill.itin", ground());
  ImportOptions lanes = options("lanes.geojson", ThemeKind::Roads, "lanes");
  lanes.name_field = "ref";
  import("hill.itin", lanes);
  {
    const Store store(path("hill.itin"));
    EXPECT_EQ(store.metadata().format_version, 6);
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
  test::write_lines(path("paths.geojson"), {other});
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
  test::expect_sound(store);

  import("bare.itin", ground());
  lanes.id_field.clear(), lanes.name_field.clear();
  lanes.attributes.emplace();
  import("bare.itin", lanes);
  const Store bare(path("bare.itin"));
  EXPECT_EQ(bare.metadata().format_version, 4);
  EXPECT_EQ(bare.metadata().themes[0].feature_blocks, 0U);
  const Edges unnamed = edges_of(bare, Window::all(), Detail::tolerance(0));
  EXPECT_FALSE(unnamed.empty());
  for (const IdentifiedEdge& e : unnamed) EXPECT_EQ(e.id, "");
}

TEST_F(FeatureIdentity, IsToldOfWhatStands) {
  LineFeature hall = test::box(300200, 199200, 300240, 199220, 12);
  hall.properties = R"({"h":12,"ref":"42","label":"Town Hall"})";
  test::write_lines(path("hall.geojson"), {test::box(300300, 199200, 300340, 199220, 5), hall});
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

TEST_F(FeatureIdentity, OfMeasuredRoofsHasTheirOutlineTogether) {
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
}  // namespace itin
