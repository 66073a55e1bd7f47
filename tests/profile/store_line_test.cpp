// A line of sight over a store in one call, against the same put together by hand.
#include <cmath>
#include <gmock/gmock.h>
#include <random>

#include <gtest/gtest.h>

#include <itin/cross_section.hpp>
#include <itin/error.hpp>
#include <itin/import.hpp>
#include <itin/store.hpp>
#include <profile/los.hpp>
#include <viewshed/viewshed.hpp>

#include "support/raster_file.hpp"
#include "support/same_bits.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin::profile {
namespace {

/// Hills of 600 m by 600 m with a hole, and one tower.
class StoreLines : public testing::Test {
 protected:
  void SetUp() override {
    test::write_raster(directory_.file("t.tif"), {300000, 200000, 10, 60, 60, 27700}, [](int c, int r) {
      if (c >= 50 && r >= 50) return double{NAN};
      return 100 + 8 * std::sin(c * 0.3) + 6 * std::cos(r * 0.23);
    });
    NoProgress progress;
    ImportOptions options;
    options.sources = {directory_.file("t.tif")};
    options.tolerances = {4, 16};
    import_terrain(directory_.file("s.itin"), options, progress);
    test::write_lines(directory_.file("b.geojson"), {test::box(300290, 199690, 300310, 199710, 30)}, true);
    options.sources = {directory_.file("b.geojson")};
    options.kind = ThemeKind::Buildings;
    options.height_field = "h";
    import_lines(directory_.file("s.itin"), options, progress);
    store_.emplace(directory_.file("s.itin"));
  }

  LosQuery query(double from_height_m, double to_height_m) const {
    LosQuery query;
    query.from_height_m = from_height_m, query.to_height_m = to_height_m;
    return query;
  }

  Profile along(const StoreLine& line, const ThemeChoice& themes) const {
    return from_section(cross_section(*store_, line.from, line.to, line.detail, themes));
  }

  Point2 anywhere() {
    std::uniform_real_distribution<double> x(300010, 300490), y(199510, 199990);
    return {x(random_), y(random_)};
  }

  void expect_refusal(const StoreLine& line, const LosQuery& query, const std::string& message) const {
    try {
      analyse(*store_, line, query);
      ADD_FAILURE() << "no error: " << message;
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(), message);
    }
  }

  test::TemporaryDirectory directory_;
  std::optional<Store> store_;
  std::mt19937 random_{7};
};

TEST_F(StoreLines, AtFullDetailAreAsByHand) {
  for (int i = 0; i < 60; ++i) {
    StoreLine line{anywhere(), anywhere()};
    if (i % 2 == 0) line.themes = ThemeChoice::all();
    LosQuery asked = query(3, 12);
    asked.from_on_surface = i % 4 == 0;
    const LosReport report = analyse(*store_, line, asked);
    const LosReport by_hand =
        analyse(along(line, line.themes), asked, i % 2 == 0 ? along(line, ThemeChoice::none()) : Profile{});
    EXPECT_EQ(report.verdict, by_hand.verdict);
    EXPECT_TRUE(test::same_bits(*report.clearance_m, *by_hand.clearance_m));
    EXPECT_EQ(report.query.clearance_error_m, 0);
    EXPECT_EQ(report.from.elevation_m, by_hand.antennas.from_m);
    EXPECT_NEAR(*report.geodesic_m, report.profile.length_m, 1);
    EXPECT_GT(report.triangles, 0U);
  }
}

TEST_F(StoreLines, OverACoarseSurfaceAreCertainOrUndecided) {
  int undecided = 0, certain = 0;
  for (int i = 0; i < 300; ++i) {
    StoreLine line{anywhere(), anywhere()};
    line.themes = ThemeChoice::all();
    const LosQuery asked = query(3, 12);
    const SightVerdict exact = analyse(*store_, line, asked).verdict;
    line.detail = Detail::tolerance(4);
    const LosReport coarse = analyse(*store_, line, asked);
    EXPECT_GT(coarse.query.clearance_error_m, 0);
    if (coarse.verdict == SightVerdict::kUndecided) {
      EXPECT_EQ(coarse.known_verdict, SightVerdict::kUndecided);
      ++undecided;
    } else {
      EXPECT_EQ(coarse.verdict, exact);
      ++certain;
    }
  }
  EXPECT_GT(undecided, 20);
  EXPECT_GT(certain, 20);
}

/// Masts that the inner ring has and the outer one leaves out.
TEST_F(StoreLines, OverRingsThatLeaveFeaturesOutAreCertainOrUndecided) {
  std::vector<test::LineFeature> masts;
  for (int i = 0; i < 60; ++i) {
    const Point2 p = anywhere();
    masts.push_back(test::box(p.x, p.y, p.x + 5, p.y + 5, 25));
  }
  test::write_lines(directory_.file("m.geojson"), masts, true);
  store_.reset();
  NoProgress progress;
  ImportOptions options;
  options.sources = {directory_.file("m.geojson")};
  options.kind = ThemeKind::Buildings;
  options.theme = "masts";
  options.height_field = "h";
  import_lines(directory_.file("s.itin"), options, progress);
  store_.emplace(directory_.file("s.itin"));
  int higher = 0;
  for (int i = 0; i < 200; ++i) {
    StoreLine line{anywhere(), anywhere()};
    line.themes = ThemeChoice::all();
    const LosQuery asked = query(6, 40);
    const LosReport exact = analyse(*store_, line, asked);
    line.detail = Detail::rings(line.from, {{40, 0}, {80, 16}});
    const LosReport thinned = analyse(*store_, line, asked);
    EXPECT_GE(*exact.clearance_m, *thinned.clearance_m - thinned.query.clearance_error_m);
    EXPECT_LE(*exact.clearance_m, *thinned.clearance_m + thinned.query.clearance_error_m);
    // As much is left out somewhere as with the outer ring's tolerance everywhere.
    line.detail = Detail::tolerance(16);
    EXPECT_EQ(thinned.query.clearance_error_m, analyse(*store_, line, asked).query.clearance_error_m);
    higher += *thinned.clearance_m > *exact.clearance_m + 10 ? 1 : 0;
    EXPECT_TRUE(thinned.verdict == SightVerdict::kUndecided || thinned.verdict == exact.verdict);
  }
  EXPECT_GT(higher, 10);  // masts stand in the way that the outer ring does not have
}

TEST_F(StoreLines, TakeElevations) {
  StoreLine line{{300100, 199900}, {300400, 199600}};
  const LosReport heights = analyse(*store_, line, query(5, 9));
  line.from_is_elevation = line.to_is_elevation = true;
  const LosReport elevations = analyse(*store_, line, query(heights.antennas.from_m, heights.antennas.to_m));
  EXPECT_NEAR(elevations.query.from_height_m, 5, 1e-9);
  EXPECT_NEAR(*elevations.clearance_m, *heights.clearance_m, 1e-9);
  try {
    analyse(*store_, line, query(20, 300));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("`from`: elevation 20 m is below what it stands on, "));
  }
}

TEST_F(StoreLines, RefuseWhatHasNoAnswer) {
  const Point2 ground{300100, 199900}, hole{300560, 199430}, outside{310000, 199900};
  expect_refusal({hole, ground}, query(2, 2),
                 "`from`: there is no ground at 300560.00,199430.00; move it onto the data");
  expect_refusal({ground, hole}, query(2, 2), "`to`: there is no ground at 300560.00,199430.00; move it onto the data");
  expect_refusal({outside, hole}, query(2, 2),
                 "`from`: there is no ground at 310000.00,199900.00; move it onto the data");
  const auto negative = [](const std::string& end) {
    return "`" + end + "_height_m`: a height must not be negative; for an elevation set `" + end + "_is_elevation`";
  };
  expect_refusal({ground, hole}, query(-1, 2), negative("from"));
  expect_refusal({hole, ground}, query(2, -1), negative("to"));
  EXPECT_THROW(analyse(*store_, {ground, ground}, query(NAN, 2)), InputError);
}

TEST_F(StoreLines, SayWhoTheyAreAbout) {
  StoreLine line{{300100, 199700}, {300480, 199700}};
  line.themes = ThemeChoice::all();
  const LosReport report = analyse(*store_, line, query(2, 2));
  EXPECT_EQ(report.verdict, SightVerdict::kHidden);
  ASSERT_TRUE(report.critical);
  EXPECT_EQ(cause_of(report, report.critical->theme, report.critical->feature), "buildings, feature 0");
  EXPECT_NEAR(report.from.site->azimuth_grid_deg, 90, 1e-9);
  EXPECT_NEAR(report.to.site->lon_lat.x, -3.4, 0.5);
  EXPECT_EQ(report.from_lines.size(), 5U);
  EXPECT_EQ(report.facts.front().second, "s.itin");
}

TEST_F(StoreLines, AndViewshedsGiveOneAnswer) {
  viewshed::Request request;
  request.observers = {{"eye", {300200, 199800}, 4}};
  request.cell_size = 10;
  request.radius = 250;
  request.target_height = 1;
  request.themes = ThemeChoice::all();
  NoProgress progress;
  const viewshed::Result result = viewshed::compute(*store_, request, progress);
  LosQuery asked = query(4, 1);
  asked.earth = request.earth;
  int visible = 0, hidden = 0;
  for (std::size_t i = 0; i < result.visible.size(); i += 7) {
    const auto columns = static_cast<std::size_t>(result.grid.columns());
    const Point2 cell =
        result.grid.centre(static_cast<std::int64_t>(i % columns), static_cast<std::int64_t>(i / columns));
    if (result.visible[i] != viewshed::Verdict::kVisible && result.visible[i] != viewshed::Verdict::kHidden) continue;
    StoreLine line{{300200, 199800}, cell};
    line.themes = request.themes;
    const bool sees = analyse(*store_, line, asked).verdict == SightVerdict::kVisible;
    EXPECT_EQ(sees, result.visible[i] == viewshed::Verdict::kVisible) << cell.x << "," << cell.y;
    ++(sees ? visible : hidden);
  }
  EXPECT_GT(visible, 20);
  EXPECT_GT(hidden, 20);
}

}  // namespace
}  // namespace itin::profile
