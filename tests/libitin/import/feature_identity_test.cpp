// A line in a store is its feature's, at every level and in every window, whatever was imported when.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "libitin/import/feature_imports.hpp"
#include "support/sound_store.hpp"

namespace itin::test {
namespace {

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

class FeatureIdentity : public FeatureImports {};

/// In the plane, for steps of 1 cm: where lines were led through crossings, and where their vertices are rounded.
constexpr double kRoundedBy = 0.015;

TEST_F(FeatureIdentity, HoldsAtEveryLevel) {
  write_lines(path("ridges.geojson"), wandering("ridge", 16));
  write_lines(path("lanes.geojson"), wandering("lane", 16));
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
        // Both ends may be rounded to one side of the line: then so is the middle, by as much as they on average.
        const bool along =
            std::max({distance_to(line, a), distance_to(line, middle), distance_to(line, b)}) < kRoundedBy;
        if (std::hypot(b.x - a.x, b.y - a.y) < 1 || id.substr(0, 4) != e.id.substr(0, 4)) continue;
        EXPECT_EQ(edges.contains({e.theme, id, e.a, e.b}), along) << id << " beside " << e.id;
      }
    }
  }
  expect_sound(store);
}

TEST_F(FeatureIdentity, IsThatOfTheWholeInEveryWindow) {
  write_lines(path("ridges.geojson"), wandering("ridge", 16));
  write_lines(path("houses.geojson"), houses(30));
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
  write_lines(path("ridges.geojson"), wandering("ridge", 10));
  write_lines(path("edges.geojson"), wandering("edge", 6));
  std::vector<LineFeature> lanes = wandering("lane", 10);
  write_lines(path("lanes.geojson"), lanes);
  // Nothing is kept of these, of which some run along lanes.
  std::vector<LineFeature> unnamed = wandering("path", 4);
  unnamed.insert(unnamed.end(), lanes.begin() + 2, lanes.begin() + 4);
  write_lines(path("unnamed.geojson"), unnamed);
  ImportOptions nameless = options("unnamed.geojson", ThemeKind::Roads, "lanes");
  nameless.id_field.clear();
  nameless.attributes.emplace();
  write_lines(path("houses.geojson"), houses(20));
  write_raster(path("survey.tif"), {300300, 199700, 5, 60, 60, 27700},
               [](int c, int r) { return 110 + 3 * std::sin(c / 3.0) + 2 * std::cos(r / 4.0); });
  ImportOptions survey = ground();
  survey.sources = {path("survey.tif")};
  survey.replace = true;
  std::vector<ImportOptions> sources{options("ridges.geojson", ThemeKind::Breaklines, "ridges"),
                                     options("edges.geojson", ThemeKind::Breaklines, "ridges"),
                                     options("lanes.geojson", ThemeKind::Roads, "lanes"),
                                     nameless,
                                     raised("houses.geojson", "houses"),
                                     survey};
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
    expect_sound(other);
  }
}

}  // namespace
}  // namespace itin::test
