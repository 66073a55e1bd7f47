// Law 4: thousands of cells of viewsheds, each asked again as a line of sight.
//
// Nothing may differ, of plain, precise and certified viewsheds.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <itin/cross_section.hpp>
#include <itin/error.hpp>
#include <itin/feature_at.hpp>
#include <itin/grazing.hpp>
#include <itin/import.hpp>
#include <itin/store.hpp>
#include <profile/los.hpp>
#include <viewshed/viewshed.hpp>

#include "support/full_detail.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin {
namespace {

using test::LineFeature;
using viewshed::Request;
using viewshed::Result;

/// The outcome for the cells asked again.
struct Agreement {
  int visible = 0, hidden = 0;  ///< by the line of sight
  int wrong = 0;                ///< cells that differ

  Agreement& operator+=(const Agreement& a) {
    visible += a.visible, hidden += a.hidden, wrong += a.wrong;
    return *this;
  }
};

std::ostream& operator<<(std::ostream& out, const Agreement& a) {
  return out << a.visible << " visible, " << a.hidden << " hidden, " << a.wrong << " wrong";
}

class OneAnswer : public testing::Test {
 protected:
  double in(double low, double high) { return low + (high - low) * static_cast<double>(random_() % 100000) / 100000; }

  profile::LosReport line_of_sight(const Store& store, const Request& request, Point2 target) const {
    const viewshed::Observer& eye = request.observers.front();
    const auto along = [&](const ThemeChoice& themes) {
      return profile::from_section(cross_section(store, eye.position, target, request.detail, themes));
    };
    profile::LosQuery query;
    query.from_height_m = eye.height, query.to_height_m = request.target_height;
    query.from_on_surface = request.observers_on_surface, query.to_on_surface = request.targets_on_surface;
    query.earth = request.earth;
    const bool raised = request.themes.includes_raised(store.metadata().themes);
    return profile::analyse(along(request.themes), query, raised ? along(ThemeChoice::none()) : profile::Profile{});
  }

  Agreement ask_again(const Store& store, const Result& result, int wanted) {
    using profile::SightVerdict;
    const bool certified = result.certified;
    const viewshed::Verdict yes = viewshed::Verdict::kVisible;
    const viewshed::Verdict no = viewshed::Verdict::kHidden;
    Request request = result.request;
    if (certified) request.detail = Detail::tolerance(0);
    Agreement agreement;
    for (int tries = 0; tries < 20 * wanted && agreement.visible + agreement.hidden < wanted; ++tries) {
      const auto column = static_cast<std::int64_t>(random_() % static_cast<unsigned>(result.grid.columns()));
      const auto row = static_cast<std::int64_t>(random_() % static_cast<unsigned>(result.grid.rows()));
      const viewshed::Verdict value = result.visible[result.grid.index({column, row})];
      if (value != yes && value != no) continue;
      const profile::LosReport line = line_of_sight(store, request, result.grid.centre(column, row));
      const bool sees = line.verdict == SightVerdict::kVisible;
      ++(sees ? agreement.visible : agreement.hidden);
      if (sees == (value == yes)) continue;
      if (++agreement.wrong < 4) {
        const Point2 p = result.grid.centre(column, row);
        ADD_FAILURE() << fmt::format("{},{}: the viewshed says {}, the clearance is {}", p.x, p.y,
                                     value == yes ? "visible" : "hidden", *line.clearance_m);
      }
    }
    std::cout << agreement << "\n";
    return agreement;
  }

  void expect_plain_agrees(const Store& store, const Request& request, int wanted) {
    NoProgress progress;
    const Result result = viewshed::compute(store, request, progress);
    expect_exact(store, result, wanted);
  }

  void expect_exact(const Store& store, const Result& result, int wanted) {
    expect_tested(ask_again(store, result, wanted), wanted);
  }

  static void expect_tested(const Agreement& agreement, int wanted) {
    EXPECT_EQ(agreement.wrong, 0);
    EXPECT_GT(agreement.visible, wanted / 50);  // otherwise nothing was tested
    EXPECT_GT(agreement.hidden, wanted / 50);
  }

  /// Plain, precise and certified, on cells about a place, one of whose centres it is; the eye stands there or within
  /// three steps of the store's grid.
  void expect_one_answer_about(const Store& store, Request request, Point2 place) {
    NoProgress progress;
    const double step = store.metadata().grid.resolution;
    const double cells[] = {step, 0.37, 3.37, 7.93}, steps[] = {0, 0, 1e-9, 1e-5, 0.4, 0.9, 1.1, 3};
    const double cell = cells[random_() % 4], off = step * steps[random_() % 8];
    const Point2 eye{place.x + off * (random_() % 2 == 0 ? 1 : -1), place.y};
    SCOPED_TRACE(fmt::format("{},{} by {} on cells of {}", place.x, place.y, eye.x - place.x, cell));
    request.observers = {{"eye", eye, in(0, 20) < 5 ? 0.0 : 2.0}};
    request.cell_size.reset();
    request.grid.emplace(Point2{place.x - 7.5 * cell, place.y + 7.5 * cell}, cell, cell, 15, 15);
    const Result plain = viewshed::compute(store, request, progress);
    EXPECT_EQ(test::compute_at_full_detail(store, request, {}, progress).result.visible, plain.visible);
    const std::size_t own = plain.grid.index({7, 7});
    if (plain.visible[own] != viewshed::Verdict::kOutside) {
      EXPECT_TRUE(plain.visible[own] == viewshed::Verdict::kVisible || off >= step);
    }
    ask_again(store, plain, 40);
    request.detail = Detail::tolerance(4);
    ask_again(store, viewshed::compute_certified(store, request, {}, progress).result, 40);
  }

  test::TemporaryDirectory directory_;
  std::mt19937 random_{test::seed()};
};

/// A town in a wood on rolling ground, 600 m on each side.
class InATown : public OneAnswer {
 protected:
  void SetUp() override {
    OneAnswer::SetUp();
    test::write_raster(directory_.file("t.tif"), {300000, 200000, 10, 60, 60, 27700}, [](int c, int r) {
      return 100 + 8 * std::sin(c * 0.3) + 6 * std::cos(r * 0.23) + 0.3 * ((c * 7 + r * 13) % 5);
    });
    ImportOptions options;
    options.sources = {directory_.file("t.tif")};
    NoProgress progress;
    import_terrain(directory_.file("s.itin"), options, progress);
    std::vector<LineFeature>& houses = houses_;
    std::vector<LineFeature> woods;
    for (int i = 0; i < 40; ++i) {
      const double x = in(300020, 300540), y = in(199440, 199940);
      houses.push_back(test::box(x, y, x + in(6, 30), y + in(6, 30), in(3, 12)));
    }
    for (int i = 0; i < 4; ++i) {
      const double x = in(300020, 300450), y = in(199440, 199850);
      woods.push_back(test::box(x, y, x + in(20, 90), y + in(20, 90), in(5, 15)));
    }
    add(ThemeKind::Vegetation, "woods", woods);
    add(ThemeKind::Buildings, "houses", houses);
    store_.emplace(directory_.file("s.itin"));
    request_.observers = {{"eye", {300287.3, 199712.9}, 2}};
    request_.cell_size = 3;
    request_.themes = ThemeChoice::all();
    request_.target_height = 1.7;
  }

  void add(ThemeKind kind, const std::string& theme, const std::vector<LineFeature>& features) {
    test::write_lines(directory_.file(theme + ".geojson"), features, true);
    ImportOptions options;
    options.sources = {directory_.file(theme + ".geojson")};
    options.kind = kind;
    options.theme = theme;
    if (kind != ThemeKind::Roads) options.height_field = "h";
    NoProgress progress;
    import_lines(directory_.file("s.itin"), options, progress);
  }

  std::optional<Store> store_;
  Request request_;
  std::vector<LineFeature> houses_;
};

TEST_F(InATown, AboutHousesCornersAndWallsPostsAndTheDatasEdge) {
  for (int i = 0; i < 30; ++i) {
    const LineFeature& house = houses_[random_() % houses_.size()];
    const Point3 &a = house.vertices[0], &b = house.vertices[1];
    const auto post = [&] { return 5 + 10 * std::floor(in(0, 59)); };
    const Point2 places[] = {{a.x, a.y},
                             {(a.x + b.x) / 2, a.y},
                             {(a.x + b.x) / 2, a.y + 0.01},
                             {300000 + post(), 199400 + post()},
                             {300005, 199400 + post()},
                             {300595, 199995},
                             {in(300020, 300580), in(199420, 199980)}};
    const std::size_t count = sizeof places / sizeof *places;
    request_.observers_on_surface = random_() % 2 == 0, request_.targets_on_surface = random_() % 2 == 0;
    request_.themes = random_() % 3 == 0 ? ThemeChoice::none() : ThemeChoice::all();
    try {
      expect_one_answer_about(*store_, request_, places[random_() % count]);
    } catch (const InputError&) {  // the eye beyond the data's edge
    }
  }
}

/// Beside a house the surface is not to the last digit the bare ground, also where the window holds no part of the
/// house.
TEST_F(InATown, BesideHousesFromTheGround) {
  NoProgress progress;
  request_.observers.front().height = request_.target_height = 0;
  request_.cell_size.reset();
  for (const bool surface : {false, true}) {
    request_.targets_on_surface = surface;
    for (const LineFeature& house : houses_) {
      const Point2 eye{house.vertices[0].x - 0.7, house.vertices[0].y + 1.3};
      SCOPED_TRACE(fmt::format("{},{}", eye.x, eye.y));
      request_.observers.front().position = eye;
      request_.grid.emplace(Point2{eye.x - 0.5, eye.y + 0.5}, 0.2, 0.2, 5, 5);
      EXPECT_EQ(ask_again(*store_, viewshed::compute(*store_, request_, progress), 30).wrong, 0);
    }
  }
}

TEST_F(InATown, OfBareGround) {
  request_.themes = ThemeChoice::none();
  for (const double height : {0.0, 1.7}) {
    request_.target_height = height;
    expect_plain_agrees(*store_, request_, 1000);
  }
}

TEST_F(InATown, WithFeaturesAndEndsOnEither) {
  request_.observers.front().height = 15;  // above any roof or tree
  for (const bool observer : {false, true}) {
    for (const bool target : {false, true}) {
      SCOPED_TRACE(
          fmt::format("observer {}, targets {}", observer ? "surface" : "ground", target ? "surface" : "ground"));
      request_.observers_on_surface = observer, request_.targets_on_surface = target;
      expect_plain_agrees(*store_, request_, 800);
    }
  }
}

TEST_F(InATown, FromUnderARoofOrCanopy) {
  NoProgress progress;
  store_.reset();
  add(ThemeKind::Vegetation, "canopy", {test::box(300200, 199600, 300380, 199800, 25)});
  store_.emplace(directory_.file("s.itin"));
  const Result result = viewshed::compute(*store_, request_, progress);
  EXPECT_EQ(result.cells.visible, 0U);
  EXPECT_GT(result.cells.hidden, 1000U);
  EXPECT_EQ(test::compute_at_full_detail(*store_, request_, {}, progress).result.visible, result.visible);
}

TEST_F(InATown, WhateverLinesLieOnTheGround) {
  NoProgress progress;
  request_.observers.front().height = 15;  // above any roof or tree
  const Result before = viewshed::compute(*store_, request_, progress);
  std::vector<LineFeature> roads;
  for (int i = 0; i < 12; ++i)
    roads.push_back({{{in(300020, 300580), in(199420, 199980), 0}, {in(300020, 300580), in(199420, 199980), 0}}});
  store_.reset();
  add(ThemeKind::Roads, "roads", roads);
  store_.emplace(directory_.file("s.itin"));
  const Result after = viewshed::compute(*store_, request_, progress);
  ASSERT_EQ(after.visible.size(), before.visible.size());
  int changed = 0;
  for (std::size_t i = 0; i < after.visible.size(); ++i) changed += after.visible[i] != before.visible[i];
  std::cout << changed << " cells changed\n";
  // Where a road crosses a house's outline both get a vertex, on the grid.
  EXPECT_LT(changed, 40);
  expect_plain_agrees(*store_, request_, 300);
  expect_exact(*store_, test::compute_at_full_detail(*store_, request_, {}, progress).result, 300);
}

TEST_F(InATown, WithFeaturesAtATolerance) {
  request_.observers.front().height = 15;
  for (const double tolerance : {2.0, 8.0}) {
    request_.detail = Detail::tolerance(tolerance);
    expect_plain_agrees(*store_, request_, 600);
  }
}

/// Woods felled and houses not built: plain, precise, certified, at a tolerance, in rings, by rays and in little
/// memory.
TEST_F(InATown, WithoutSomeFeatures) {
  NoProgress progress;
  request_.observers.front().height = 15;  // above any roof or tree
  std::vector<FeatureNumber> omitted;
  const std::vector<ThemeInfo>& themes = store_->metadata().themes;
  for (std::uint16_t theme = 1; theme <= themes.size(); ++theme)
    for (const FeatureAt& f : themes[theme - 1U].is_raised() ? features_of(*store_, theme) : std::vector<FeatureAt>())
      if (random_() % 2 == 0) omitted.push_back({theme, f.number});
  const Result before = viewshed::compute(*store_, request_, progress);
  request_.themes = without_features(*store_, request_.themes, omitted, progress);
  const Result plain = viewshed::compute(*store_, request_, progress);
  EXPECT_GT(plain.cells.visible, before.cells.visible);
  for (std::size_t cell = 0; cell < plain.visible.size(); ++cell)
    EXPECT_FALSE(before.visible[cell] == viewshed::Verdict::kVisible &&
                 plain.visible[cell] == viewshed::Verdict::kHidden);
  expect_exact(*store_, plain, 800);
  EXPECT_EQ(test::compute_at_full_detail(*store_, request_, {.memory_bytes = 1 << 20}, progress).result.visible,
            plain.visible);
  Request by_rays = request_;
  by_rays.engine = viewshed::Engine::kRays;
  EXPECT_EQ(viewshed::compute(*store_, by_rays, progress).visible, plain.visible);
  for (const double tolerance : {2.0, 8.0}) {
    request_.detail = Detail::tolerance(tolerance);
    expect_plain_agrees(*store_, request_, 300);
    expect_exact(*store_, viewshed::compute_certified(*store_, request_, {}, progress).result, 300);
  }
  request_.detail = Detail::rings(request_.observers.front().position, {{80, 0}, {120, 8}, {320, 32}});
  ask_again(*store_, viewshed::compute(*store_, request_, progress), 300);
}

/// Rings that leave most houses out, seen over what they have.
TEST_F(InATown, InRingsThatThinFeatures) {
  request_.observers.front().height = 15;
  NoProgress progress;
  for (const bool target : {false, true}) {
    request_.targets_on_surface = target;
    // In the smallest rings little may be left that hides anything.
    Agreement of_all;
    for (const double radius : {20.0, 80.0, 200.0}) {
      request_.detail = Detail::rings(request_.observers.front().position,
                                      {{radius, 0}, {1.5 * radius, 8}, {2 * radius, 16}, {4 * radius, 32}});
      of_all += ask_again(*store_, viewshed::compute(*store_, request_, progress), 400);
    }
    expect_tested(of_all, 1200);
  }
}

TEST_F(InATown, PreciseAgreesEntirelyWithFeatures) {
  NoProgress progress;
  request_.observers.front().height = 15;
  for (const bool target : {false, true}) {
    request_.targets_on_surface = target;
    expect_exact(*store_, test::compute_at_full_detail(*store_, request_, {}, progress).result, 800);
  }
}

TEST_F(InATown, OverAFlatEarth) {
  request_.earth = Earth::flat();
  request_.target_height = 0;
  request_.targets_on_surface = true;
  request_.observers.front().height = 15;
  expect_plain_agrees(*store_, request_, 600);
}

/// 20 km square about Cardiff, 160,000 posts.
class InWales : public OneAnswer {
 protected:
  void SetUp() override {
    OneAnswer::SetUp();
    ImportOptions options;
    for (const char* tile : {"st08", "st18", "st07", "st17"}) {
      options.sources.push_back(ITIN_DATA_DIR "/os-terrain50-wales/tiles/" + std::string(tile) + ".zip");
      if (!std::filesystem::exists(options.sources.back())) GTEST_SKIP() << "no " << options.sources.back();
    }
    NoProgress progress;
    import_terrain(directory_.file("s.itin"), options, progress);
    store_.emplace(directory_.file("s.itin"));
    request_.observers = {{"mast", {310580, 182340}, 20}};
    request_.cell_size = 50;
    request_.target_height = 2;
    request_.radius = 9000;
  }

  std::optional<Store> store_;
  Request request_;
};

TEST_F(InWales, PlainAtEveryTolerance) {
  for (const double tolerance : {0.0, 2.0, 8.0}) {
    SCOPED_TRACE(tolerance);
    request_.detail = Detail::tolerance(tolerance);
    expect_plain_agrees(*store_, request_, 1500);
  }
}

TEST_F(InWales, AboutCellCentresAndPosts) {
  for (int i = 0; i < 20; ++i) {
    const Point2 place{std::round(in(305000, 315000) * 1000) / 1000, std::round(in(175000, 185000) * 1000) / 1000};
    const Point2 post{std::floor(place.x / 50) * 50 + 25, std::floor(place.y / 50) * 50 + 25};
    request_.target_height = i % 3;
    expect_one_answer_about(*store_, request_, i % 4 == 0 ? post : place);
  }
}

TEST_F(InWales, PlainInRings) {
  request_.detail = Detail::rings(request_.observers.front().position, {{1000, 0}, {3000, 2}, {20000, 8}});
  expect_plain_agrees(*store_, request_, 1500);
}

TEST_F(InWales, PreciseAgreesEntirely) {
  NoProgress progress;
  for (const double height : {0.0, 2.0}) {
    request_.target_height = height;
    const Result result = test::compute_at_full_detail(*store_, request_, {}, progress).result;
    expect_exact(*store_, result, 2000);
  }
}

TEST_F(InWales, CertainlyIsCertain) {
  NoProgress progress;
  request_.detail = Detail::tolerance(1);
  request_.target_height = 30;
  expect_exact(*store_, viewshed::compute_certified(*store_, request_, {}, progress).result, 2000);
}

}  // namespace
}  // namespace itin
