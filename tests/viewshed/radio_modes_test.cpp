// Fresnel zones and losses of every cell, against the report that itin los makes of that line.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/import.hpp>
#include <profile/links.hpp>
#include <viewshed/site_coverage.hpp>
#include <viewshed/viewshed.hpp>

#include "support/hills_and_town.hpp"
#include "support/raster_file.hpp"
#include "support/same_result.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/terrain_tin.hpp"
#include "support/viewshed_of.hpp"

namespace itin::viewshed {
namespace {

constexpr Point2 kNorthWest{300000, 200000};
constexpr double kPostStep = 50;
constexpr int kPosts = 70;

class RadioModes : public ::testing::Test {
 protected:
  double draw(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  /// Somewhere in the box where there is ground.
  Observer observer_on(const Store& store, const Box& box) {
    while (true) {
      const Point2 place{draw(box.xmin, box.xmax), draw(box.ymin, box.ymax)};
      if (ground_under(store, {place}, ThemeChoice::none(), progress_)[0]) return {"", place, std::round(draw(2, 40))};
    }
  }

  /// Hills with a hole.
  std::string hills() {
    const std::vector<double> z = test::fractal_heights(129, 150, 0.55, static_cast<unsigned>(random_()));
    test::write_raster(directory_.file("t.tif"), {kNorthWest.x, kNorthWest.y, kPostStep, kPosts, kPosts, 27700},
                       [&](int c, int r) {
                         if (std::hypot(c - 0.35 * kPosts, r - 0.6 * kPosts) < 6) return std::nan("");
                         return z[static_cast<std::size_t>(r) * 129 + static_cast<std::size_t>(c)];
                       });
    ImportOptions options;
    options.sources = {directory_.file("t.tif")};
    import_terrain(directory_.file("s.itin"), options, progress_);
    return directory_.file("s.itin");
  }
  static Box middle_of_hills() {
    return {kNorthWest.x + 200, kNorthWest.y - kPostStep * kPosts + 200, kNorthWest.x + kPostStep * kPosts - 200,
            kNorthWest.y - 200};
  }

  Request at_random(Mode mode) {
    Request request;
    request.mode = mode;
    request.target_height = draw(0.5, 10);
    request.earth = draw(0, 1) < 0.5 ? Earth{} : Earth::effective_earth(4.0 / 3);
    request.radio.frequency_ghz = std::exp(draw(std::log(0.2), std::log(10)));
    request.radio.effective_earth_km = effective_earth_km(request.earth);
    if (draw(0, 1) < 0.5) request.radio.polarisation = Polarisation::kVertical;
    request.radio.over_sea = draw(0, 1);
    request.fresnel = {wavelength_m(request.radio.frequency_ghz), draw(0.1, 1)};
    return request;
  }

  /// The lines from the first observer to every cell of the result.
  static std::vector<profile::Link> links_of(const Result& result) {
    const Observer& observer = result.request.observers.front();
    std::vector<profile::Link> links;
    for (std::int64_t row = 0; row < result.grid.rows(); ++row)
      for (std::int64_t column = 0; column < result.grid.columns(); ++column)
        links.push_back(
            {"", observer.position, observer.height, result.grid.centre(column, row), result.request.target_height});
    return links;
  }

  /// The answers of itin los for these lines.
  std::vector<profile::LinkResult> lines_of(const Store& store, const Result& result) {
    const Request& request = result.request;
    profile::LinkQuery query;
    query.earth = request.earth;
    query.themes = request.themes;
    query.radio = request.radio;
    query.nodata = request.nodata;
    query.from_on_surface = request.observers_on_surface;
    query.to_on_surface = request.targets_on_surface;
    return survey_links(store, links_of(result), query, progress_);
  }

  void expect_zones_of_lines(const Store& store, const Request& request) {
    const Result result = compute(store, request, progress_);
    const std::vector<profile::LinkResult> lines = lines_of(store, result);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (result.visible[i] == Verdict::kOutside) continue;
      ASSERT_TRUE(lines[i].found) << lines[i].message;
      const profile::LineFindings& found = *lines[i].found;
      const bool clear = !found.fresnel || found.fresnel->fraction >= request.fresnel.fraction;
      const Verdict expected = found.verdict == profile::SightVerdict::kHidden      ? Verdict::kHidden
                               : found.verdict == profile::SightVerdict::kUndecided ? Verdict::kUndecided
                               : clear                                              ? Verdict::kVisible
                                                                                    : Verdict::kZoneCut;
      wrong += result.visible[i] == expected ? 0 : 1;
    }
    EXPECT_EQ(wrong, 0U) << "of " << lines.size();
    found_ += result.cells;
  }

  static void expect_near(float value, double expected) {
    EXPECT_NEAR(value, expected, 1e-4) << "of the loss that itin los prints to hundredths";
  }

  void expect_losses_of_lines(const Store& store, const Request& request) {
    const Result result = compute(store, request, progress_);
    const std::vector<profile::LinkResult> lines = lines_of(store, result);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (result.visible[i] == Verdict::kOutside) {
        ASSERT_TRUE(std::isnan(result.get<Losses>().diffraction_db[i]) &&
                    std::isnan(result.get<Losses>().free_space_db[i]));
        continue;
      }
      const bool known = lines[i].losses && (lines[i].gap_m == 0 || request.nodata == NoData::kClear);
      ASSERT_EQ(!std::isnan(result.get<Losses>().diffraction_db[i]), known) << lines[i].gap_m;
      ASSERT_EQ(!std::isnan(result.get<Losses>().free_space_db[i]), known);
      if (!known) {
        ++without_loss_;
        continue;
      }
      expect_near(result.get<Losses>().diffraction_db[i], lines[i].losses->ld_db);
      expect_near(result.get<Losses>().free_space_db[i], lines[i].losses->free_space_db);
      ++with_loss_;
      if (HasFailure()) return;
    }
    found_ += result.cells;
  }

  /// Levels, margins and outages are those that itin los --links tells of the lines.
  void expect_levels_of_lines(const Store& store, const Request& request) {
    const Result result = compute(store, request, progress_);
    const std::vector<profile::LinkResult> lines = lines_of(store, result);
    const std::vector<profile::Link> links = links_of(result);
    const auto& levels = result.get<Levels>();
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const bool known = result.visible[i] != Verdict::kOutside && lines[i].losses &&
                         (lines[i].gap_m == 0 || request.nodata == NoData::kClear);
      ASSERT_EQ(!std::isnan(levels.level_dbm[i]), known) << i;
      if (!known) continue;
      const profile::LinkQuery query{.earth = request.earth, .radio = request.radio, .budget = request.budget};
      const profile::LinkBudget budget = *link_budget_of(links[i], lines[i], query);
      expect_near(levels.level_dbm[i], budget.level_dbm);
      ++with_level_;
      const float outage = levels.outage_minutes.empty() ? std::nanf("") : levels.outage_minutes[i];
      ASSERT_EQ(!std::isnan(outage), budget.availability.has_value());
      if (budget.availability) {
        EXPECT_NEAR(outage, budget.availability->outage_minutes, 1e-4 * budget.availability->outage_minutes);
        ++with_outage_;
      }
      if (HasFailure()) return;
    }
  }

  /// The level is the greatest of those that each observer has alone, and the observer the one who has it.
  void expect_best_of_each(const Store& store, const Result& all) {
    std::vector<Result> each;
    for (std::size_t i = 0; i < all.request.observers.size(); ++i)
      each.push_back(compute(store, request_for_observer(all, i), progress_));
    const auto& levels = all.get<Levels>();
    for (std::size_t cell = 0; cell < all.visible.size(); ++cell) {
      float greatest = std::nanf("");
      for (const Result& one : each) greatest = std::fmax(greatest, one.get<Levels>().level_dbm[cell]);
      const float level = levels.level_dbm[cell];
      ASSERT_TRUE(level == greatest || (std::isnan(level) && std::isnan(greatest)));
      ASSERT_EQ(levels.observer[cell] == 0, std::isnan(level));
      if (levels.observer[cell] > 0) {
        ASSERT_EQ(each[levels.observer[cell] - 1].get<Levels>().level_dbm[cell], level);
      }
    }
  }

  static void expect_least_loss(const std::vector<Result>& each, const Result& all, std::size_t cell) {
    float least = std::numeric_limits<float>::infinity();
    bool unknown = false;
    for (const Result& one : each) {
      const bool known = !std::isnan(one.get<Losses>().diffraction_db[cell]);
      unknown = unknown || (!known && all.request.nodata == NoData::kUnknown);
      if (known)
        least = std::min(least, one.get<Losses>().diffraction_db[cell] + one.get<Losses>().free_space_db[cell]);
    }
    if (unknown || std::isinf(least)) {
      ASSERT_TRUE(std::isnan(all.get<Losses>().diffraction_db[cell]));
    } else {
      ASSERT_EQ(all.get<Losses>().diffraction_db[cell] + all.get<Losses>().free_space_db[cell], least);
    }
  }

  test::TemporaryDirectory directory_;
  std::mt19937 random_{test::seed()};
  NoProgress progress_;
  CellCounts found_;
  std::size_t with_loss_ = 0, without_loss_ = 0, with_level_ = 0, with_outage_ = 0;
};

TEST_F(RadioModes, ZonesAreThoseOfLinesOverHillsAndAcrossMissingGround) {
  const Store store(hills());
  for (const NoData nodata : {NoData::kUnknown, NoData::kBlock, NoData::kClear}) {
    SCOPED_TRACE(static_cast<int>(nodata));
    Request request = at_random(Mode::kFresnel);
    request.nodata = nodata;
    request.observers = {observer_on(store, middle_of_hills())};
    request.cell_size = 40;
    expect_zones_of_lines(store, request);
  }
  EXPECT_GT(found_.visible, 100U);
  EXPECT_GT(found_.zone_cut, 100U);
  EXPECT_GT(found_.hidden, 100U);
}

TEST_F(RadioModes, LossesAreThoseOfLinesOverHillsAndAcrossMissingGround) {
  const Store store(hills());
  for (const NoData nodata : {NoData::kUnknown, NoData::kBlock, NoData::kClear}) {
    SCOPED_TRACE(static_cast<int>(nodata));
    Request request = at_random(Mode::kLoss);
    request.nodata = nodata;
    request.observers = {observer_on(store, middle_of_hills())};
    request.cell_size = 60;
    expect_losses_of_lines(store, request);
  }
  EXPECT_GT(with_loss_, 3000U);
  EXPECT_GT(without_loss_, 20U);
}

/// An antenna whose beam is 60 degrees wide, with 20 dB less behind.
std::shared_ptr<const profile::AntennaPattern> sector() {
  auto pattern = std::make_shared<profile::AntennaPattern>();
  for (int degrees = 0; degrees < 360; ++degrees) {
    const double off = std::min(degrees, 360 - degrees);
    pattern->horizontal.emplace_back(degrees, std::min(3 * off * off / 900, 20.0));
    pattern->vertical.emplace_back(degrees, std::min(3 * off * off / 25, 20.0));
  }
  pattern->gain_dbi = 17;
  return pattern;
}

TEST_F(RadioModes, LevelsAreThoseOfLinesByEveryKindOfBudget) {
  const Store store(hills());
  const profile::BudgetQuery bare{.eirp_dbm = 40};
  const profile::BudgetQuery rainy{.power_dbm = 18,
                                   .from_gain_dbi = 16,
                                   .to_gain_dbi = 12,
                                   .from_feeder_db = 1.5,
                                   .to_feeder_db = 0.5,
                                   .sensitivity_dbm = -90,
                                   .rain_rate_mm_h = 35};
  profile::BudgetQuery aimed{.power_dbm = 20, .sensitivity_dbm = -85};
  aimed.from_antenna = {sector(), 40, 3}, aimed.to_antenna = {sector(), {}, {}};
  for (const NoData nodata : {NoData::kUnknown, NoData::kBlock, NoData::kClear}) {
    for (const profile::BudgetQuery& budget : {bare, rainy, aimed}) {
      Request request = at_random(Mode::kLevel);
      request.radio.frequency_ghz *= 2;
      request.budget = budget;
      request.nodata = nodata;
      request.observers = {observer_on(store, middle_of_hills())};
      request.cell_size = 120;
      expect_levels_of_lines(store, request);
    }
  }
  EXPECT_GT(with_level_, 3000U);
  EXPECT_GT(with_outage_, 100U);
}

TEST_F(RadioModes, OfSeveralObserversTheGreatestLevelCounts) {
  const Store store(hills());
  Request request = at_random(Mode::kLevel);
  request.budget = {.power_dbm = 20, .sensitivity_dbm = -85};
  request.budget.from_antenna = {sector(), 250, 0};
  request.nodata = NoData::kBlock;
  for (int i = 0; i < 3; ++i) request.observers.push_back(observer_on(store, middle_of_hills()));
  request.cell_size = 110;
  const Result all = compute(store, request, progress_);
  expect_best_of_each(store, all);
}

TEST_F(RadioModes, SectorsOfAMastHaveAntennasOfTheirOwn) {
  const Store store(hills());
  Request request = at_random(Mode::kLevel);
  request.budget = {.power_dbm = 20, .sensitivity_dbm = -85, .rain_rate_mm_h = 30};
  request.budget.from_antenna = {sector(), {}, 2};
  request.radio.frequency_ghz = 7;
  const Observer mast{"", {kNorthWest.x + 1750, kNorthWest.y - 1750}, 30};
  for (const double azimuth : {10.0, 130.0, 250.0}) {
    request.observers.push_back(mast);
    request.observers.back().antenna.azimuth_deg = azimuth;
  }
  request.cell_size = 130;
  const Result all = compute(store, request, progress_);
  expect_best_of_each(store, all);
  for (std::size_t i = 0; i < 3; ++i) {
    Request one = request;
    one.observers.resize(1);
    one.observers.front().antenna = {};
    one.budget.from_antenna.azimuth_deg = request.observers[i].antenna.azimuth_deg;
    expect_levels_of_lines(store, one);
    EXPECT_TRUE(test::same_values(compute(store, one, progress_).get<Levels>().level_dbm,
                                  compute(store, request_for_observer(all, i), progress_).get<Levels>().level_dbm));
    EXPECT_GT(std::count(all.get<Levels>().observer.begin(), all.get<Levels>().observer.end(), i + 1), 20);
  }
  request.observers[1].antenna = {};
  EXPECT_THROW(compute(store, request, progress_), InputError) << "a pattern without azimuth";
}

/// Houses stand in the way of both; the smooth surface under a path is that of the ground.
TEST_F(RadioModes, AreThoseOfLinesAmongHouses) {
  const test::HillsAndTown stores;
  const Store store(stores.town());
  for (const bool on_surface : {false, true}) {
    SCOPED_TRACE(on_surface);
    Request request = at_random(Mode::kFresnel);
    request.themes = ThemeChoice::all();
    request.observers = {{"street", {321800, 4297750}, 6}};
    request.observers_on_surface = request.targets_on_surface = on_surface;
    request.radius = 150, request.cell_size = 3.7;
    expect_zones_of_lines(store, request);
    request.mode = Mode::kLoss;
    request.cell_size = 7.3;
    expect_losses_of_lines(store, request);
    request.mode = Mode::kLevel;
    request.budget = {.power_dbm = 20, .sensitivity_dbm = -85};
    expect_levels_of_lines(store, request);
  }
  EXPECT_GT(found_.zone_cut, 100U);
  EXPECT_GT(with_loss_, 1000U);
}

TEST_F(RadioModes, AreThoseOfLinesOverCardiff) {
  ImportOptions options;
  options.sources = {std::string(ITIN_SOURCE_DIR) + "/scripts/demo-data/cardiff.tif"};
  import_terrain(directory_.file("cardiff.itin"), options, progress_);
  const Store store(directory_.file("cardiff.itin"));
  Request request = at_random(Mode::kFresnel);
  request.observers = {{"Garth Hill", {310375, 183525}, 20}};
  request.radius = 8000, request.cell_size = 230;
  expect_zones_of_lines(store, request);
  request.mode = Mode::kLoss;
  expect_losses_of_lines(store, request);
  EXPECT_GT(with_loss_, 3000U);
}

/// A hair less than the fraction that itin los reports of a cell's line is clear, a hair more is not.
TEST_F(RadioModes, ZonesAreCutFromTheFractionOfLinesOn) {
  const Store store(hills());
  Request request = at_random(Mode::kFresnel);
  request.nodata = NoData::kClear;
  request.observers = {observer_on(store, middle_of_hills())};
  request.cell_size = 170;
  const Result all = compute(store, request, progress_);
  const std::vector<profile::LinkResult> lines = lines_of(store, all);
  constexpr double kHair = 1e-8;  // a part of the radius: heights are rounded otherwise there
  int looked_at = 0;
  for (std::size_t i = 0; i < lines.size() && looked_at < 40; ++i) {
    if (all.visible[i] == Verdict::kHidden || all.visible[i] == Verdict::kOutside) continue;
    const double fraction = lines[i].found->fresnel->fraction;
    if (fraction <= 0.01 || fraction >= 0.99) continue;
    ++looked_at;
    request.grid.emplace(all.grid.part(
        {static_cast<std::int64_t>(i) % all.grid.columns(), static_cast<std::int64_t>(i) / all.grid.columns()}, 1, 1));
    request.cell_size.reset();
    request.fresnel.fraction = fraction - kHair;
    EXPECT_EQ(compute(store, request, progress_).visible[0], Verdict::kVisible) << fraction;
    request.fresnel.fraction = fraction + kHair;
    EXPECT_EQ(compute(store, request, progress_).visible[0], Verdict::kZoneCut) << fraction;
  }
  EXPECT_GT(looked_at, 0);
}

/// Two masts of 4 m on a plain, 1600 m apart, at a wavelength of 16 cm: the zone's radius in the middle is 8 m.
Request over_a_plain() {
  Request request;
  request.mode = Mode::kFresnel;
  request.earth = Earth::flat();
  request.observers = {{"", {test::kCorner.x + 500, test::kCorner.y + 500}, 4}};
  request.target_height = 4;
  request.grid.emplace(Point2{test::kCorner.x + 2050, test::kCorner.y + 550}, 100, 100, 1, 1);
  request.fresnel.wavelength = 0.16;
  return request;
}

TEST_F(RadioModes, AZoneThatIsClearByExactlyTheFractionIsClear) {
  const Tin plain = test::lattice_tin(31, 11, 100, [](std::int32_t, std::int32_t) { return 0.0; });
  Request request = over_a_plain();
  request.fresnel.fraction = 0.5;
  EXPECT_EQ(test::run(plain, request).visible[0], Verdict::kVisible);
  request.fresnel.fraction = std::nextafter(0.5, 1);
  EXPECT_EQ(test::run(plain, request).visible[0], Verdict::kZoneCut);
  request.observers.front().height = request.target_height = 8;
  request.fresnel.fraction = 1;
  EXPECT_EQ(test::run(plain, request).visible[0], Verdict::kVisible);
}

/// v = 0.2, J(v) = 7.767 dB, and Bullington's (1 - exp(-J / 6)) (10 + 0.02 * 2) = 7.289 dB more; the smooth Earth is
/// far below. In free space 20 log10(4 pi 2000 / 0.1) dB.
TEST_F(RadioModes, AKnifeEdgeCostsWhatItCostsByHand) {
  const Tin ridge =
      test::lattice_tin(31, 11, 100, [](std::int32_t column, std::int32_t) { return column == 15 ? 101.0 : 0.0; });
  Request request = over_a_plain();
  request.mode = Mode::kLoss;
  request.observers.front().height = request.target_height = 100;
  request.grid.emplace(Point2{test::kCorner.x + 2450, test::kCorner.y + 550}, 100, 100, 1, 1);
  request.radio.frequency_ghz = kSpeedOfLight / 0.1;
  request.radio.effective_earth_km = effective_earth_km(request.earth);
  const Result result = test::run(ridge, request);
  EXPECT_EQ(result.visible[0], Verdict::kHidden);
  EXPECT_NEAR(result.get<Losses>().diffraction_db[0], 15.056, 0.001);
  EXPECT_NEAR(result.get<Losses>().free_space_db[0], 108.005, 0.001);
}

/// The best verdict that any observer has, undecided where another might have a better one; the least sum of losses.
TEST_F(RadioModes, OfSeveralObserversTheBestCounts) {
  const Store store(hills());
  for (const NoData nodata : {NoData::kUnknown, NoData::kBlock}) {
    SCOPED_TRACE(static_cast<int>(nodata));
    Request request = at_random(Mode::kFresnel);
    request.nodata = nodata;
    for (int i = 0; i < 3; ++i) request.observers.push_back(observer_on(store, middle_of_hills()));
    request.cell_size = 70;
    const auto rank = [](Verdict v) {
      constexpr Verdict kOrder[] = {Verdict::kVisible, Verdict::kUndecided, Verdict::kZoneCut, Verdict::kHidden,
                                    Verdict::kOutside};
      return std::find(std::begin(kOrder), std::end(kOrder), v) - std::begin(kOrder);
    };
    for (const Mode mode : {Mode::kFresnel, Mode::kLoss}) {
      request.mode = mode;
      const Result all = compute(store, request, progress_);
      std::vector<Result> each;
      for (std::size_t i = 0; i < 3; ++i) each.push_back(compute(store, request_for_observer(all, i), progress_));
      for (std::size_t cell = 0; cell < all.visible.size(); ++cell) {
        const auto best = std::min_element(each.begin(), each.end(), [&](const Result& a, const Result& b) {
          return rank(a.visible[cell]) < rank(b.visible[cell]);
        });
        ASSERT_EQ(all.visible[cell], best->visible[cell]);
        if (mode == Mode::kLoss) expect_least_loss(each, all, cell);
      }
    }
  }
}

TEST_F(RadioModes, RefuseWhatHasNoAnswer) {
  const Tin plain = test::lattice_tin(31, 11, 100, [](std::int32_t, std::int32_t) { return 0.0; });
  const auto refused = [&](const auto& change) {
    Request request = over_a_plain();
    request.radio.frequency_ghz = 2;
    request.radio.effective_earth_km = effective_earth_km(request.earth);
    change(request);
    EXPECT_THROW(test::run(plain, request), InputError);
  };
  refused([](Request& r) { r.fresnel.wavelength = 0; });
  refused([](Request& r) { r.fresnel.fraction = 0; });
  refused([](Request& r) { r.fresnel.fraction = 1.01; });
  refused([](Request& r) { r.target_height = 0; });
  refused([](Request& r) { r.observers.front().target_height = 0; });
  refused([](Request& r) { r.observers.front().height = 0; });
  refused([](Request& r) { r.mode = Mode::kLoss, r.radio.frequency_ghz = 0; });
  refused([](Request& r) { r.mode = Mode::kLoss, r.radio.over_sea = 1.5; });
  refused([](Request& r) { r.mode = Mode::kLoss, r.radio.effective_earth_km = 8500; });
  const auto level_refused = [&](const auto& change) {
    refused([&](Request& r) {
      r.mode = Mode::kLevel, r.budget = {.power_dbm = 20, .sensitivity_dbm = -85};
      change(r);
    });
  };
  level_refused([](Request& r) { r.budget = {}; });
  level_refused([](Request& r) { r.budget.geoclimatic_factor = 1e-4; });
  level_refused([](Request& r) { r.budget.from_antenna = {sector(), {}, 2}; });
  level_refused([](Request& r) { r.budget.from_antenna = {sector(), 20, {}}; });
  level_refused([](Request& r) { r.margins_db = {10, 10}; });
  level_refused([](Request& r) { r.budget.sensitivity_dbm.reset(), r.margins_db = {10}; });
}

}  // namespace
}  // namespace itin::viewshed
