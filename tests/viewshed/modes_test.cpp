// Which observers see a cell, at what angle, and the nearest of them: against the exact line of sight of every
// observer.
#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <viewshed/result.hpp>

#include "support/exact_line_of_sight.hpp"
#include "support/terrain_tin.hpp"
#include "support/viewshed_of.hpp"

namespace itin::viewshed {
namespace {

using test::kCorner;

/// Lines this near to grazing may fall either way in single precision.
constexpr double kNearGrazing = 0.02;

using test::run;

/// Observers strewn over a kilometre and a half of hills, some with views of their own.
Request strewn(std::size_t count, Mode mode) {
  Request request;
  request.mode = mode;
  request.target_height = 1;
  request.cell_size = count > 10 ? 160 : 100;
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = 2.4 * static_cast<double>(i), out = 120 * std::sqrt(static_cast<double>(i));
    request.observers.push_back(
        {"", {kCorner.x + 803 + out * std::cos(turn), kCorner.y + 798 + out * std::sin(turn)}, 5});
  }
  request.observers[0].radius = 500;
  request.observers[1].target_height = 30;
  request.observers[2].azimuth = AngleRange{300, 60};
  return request;
}

/// The view that one observer has of one cell.
struct Sight {
  enum { kOut, kHides, kSees, kEither } verdict = kOut;
  double distance = 0;
  double angle_deg = 0;
};

class SlowTwin {
 public:
  SlowTwin(const Tin& tin, const Request& request) : request_(request), exact_(tin, request.earth) {
    for (const Observer& o : request.observers) {
      const double ground = exact_.height(o.position).value();
      eyes_.push_back({o.position.x, o.position.y, ground + o.height});
    }
  }

  Sight look(std::size_t observer, Point2 centre) const {
    const Observer& o = request_.observers[observer];
    const Point3& eye = eyes_[observer];
    const auto ground = exact_.height(centre);
    const double dx = centre.x - eye.x, dy = centre.y - eye.y, distance = std::hypot(dx, dy);
    if (!ground || distance > o.radius.value_or(1e9)) return {};
    if (o.azimuth) {
      const double azimuth = std::atan2(dx, dy) * 180 / std::numbers::pi;
      if (std::abs(azimuth) > 60) return {};
    }
    const Point3 target{centre.x, centre.y, *ground + o.target_height.value_or(request_.target_height)};
    const double clearance = exact_.clearance(eye, target);
    const double drop = request_.earth.drop(distance);
    const double angle = std::atan2(target.z - drop - eye.z, distance) * 180 / std::numbers::pi;
    return {std::abs(clearance) < kNearGrazing ? Sight::kEither
            : clearance < 0                    ? Sight::kHides
                                               : Sight::kSees,
            distance, angle};
  }

  /// Calls check(cell, sights) for cells where no line is near to grazing; how many these are.
  template <class Check>
  std::size_t for_each_clear_cell(const RasterGrid& grid, const Check& check) const {
    std::size_t cells = 0;
    for (std::int64_t row = 0; row < grid.rows(); ++row) {
      for (std::int64_t column = 0; column < grid.columns(); ++column) {
        std::vector<Sight> sights;
        bool clear = true;
        for (std::size_t i = 0; i < eyes_.size(); ++i) {
          sights.push_back(look(i, grid.centre(column, row)));
          clear = clear && sights.back().verdict != Sight::kEither;
        }
        if (!clear) continue;
        ++cells;
        check(grid.index({column, row}), sights);
      }
    }
    return cells;
  }

 private:
  const Request& request_;
  test::ExactLineOfSight exact_;
  std::vector<Point3> eyes_;
};

Tin hills() {
  return test::fractal_tin(33, 50, 60, 0.55, 11);
}

bool sees(const Result& result, std::size_t cell, std::size_t observer) {
  const RasterBit bit = raster_bit(observer);
  return (result.get<ObserverSets>().words[bit.grid * result.grid.cell_count() + cell] & bit.mask) != 0;
}

void expect_classes_agree(const Result& result, std::size_t cell, const std::vector<Sight>& sights) {
  const auto any = [&](auto verdict) {
    return std::any_of(sights.begin(), sights.end(), [&](const Sight& s) { return s.verdict == verdict; });
  };
  const Verdict expected = any(Sight::kSees)    ? Verdict::kVisible
                           : any(Sight::kHides) ? Verdict::kHidden
                                                : Verdict::kOutside;
  EXPECT_EQ(result.visible[cell], expected);
}

TEST(Modes, WhichHasABitAnObserver) {
  const Tin tin = hills();
  for (const std::size_t count : {5U, 32U, 37U}) {
    const Request request = strewn(count, Mode::kWhich);
    const Result result = run(tin, request);
    ASSERT_EQ(result.get<ObserverSets>().words.size(), result.grid.cell_count() * (count > 32 ? 2 : 1));
    std::size_t bits = 0;
    const std::size_t cells =
        SlowTwin(tin, request).for_each_clear_cell(result.grid, [&](std::size_t cell, const auto& sights) {
          for (std::size_t i = 0; i < count; ++i) {
            EXPECT_EQ(sees(result, cell, i), sights[i].verdict == Sight::kSees) << "cell " << cell << " observer " << i;
            bits += sees(result, cell, i) ? 1 : 0;
          }
          expect_classes_agree(result, cell, sights);
        });
    EXPECT_GT(cells, result.grid.cell_count() / 3);
    EXPECT_GT(bits, cells / 4);
    if (count > 32) {  // bits of nobody stay clear
      for (std::size_t cell = 0; cell < result.grid.cell_count(); ++cell)
        EXPECT_EQ(result.get<ObserverSets>().words[result.grid.cell_count() + cell] >> 5, 0U);
    }
  }
}

/// More observers than are looked from at a time: what all of them see is what each sees alone.
TEST(Modes, ManyObserversSeeWhatEachSeesAlone) {
  const Tin tin = hills();
  Request request;
  request.target_height = 1;
  // Two tiles, some way off for most.
  request.grid = RasterGrid({kCorner.x + 1000, kCorner.y + 1200}, 8, 8, 70, 12);
  for (std::size_t i = 0; i < 600; ++i) {
    const double turn = 2.4 * static_cast<double>(i), out = 31 * std::sqrt(static_cast<double>(i));
    request.observers.push_back(
        {"", {kCorner.x + 803 + out * std::cos(turn), kCorner.y + 798 + out * std::sin(turn)}, 2});
    if (i % 5 == 0) request.observers.back().radius = 300 + static_cast<double>(i);
  }
  const auto in_mode = [&](Mode mode) {
    Request of_all = request;
    of_all.mode = mode;
    return run(tin, of_all);
  };
  const Result which = in_mode(Mode::kWhich), count = in_mode(Mode::kCount), nearest = in_mode(Mode::kNearest),
               angle = in_mode(Mode::kAngle), height = in_mode(Mode::kHeight), visible = in_mode(Mode::kVisible);
  const std::size_t cells = request.grid->cell_count();
  std::vector<std::uint16_t> counted(cells, kCountOutside);
  std::vector<float> distance(cells, std::numeric_limits<float>::infinity());
  std::vector<float> greatest(cells, -std::numeric_limits<float>::infinity());
  std::vector<float> least(cells, std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < request.observers.size(); ++i) {
    Request alone = request;
    alone.observers = {request.observers[i]};
    alone.mode = Mode::kAngle;
    const Result one = run(tin, alone);
    alone.mode = Mode::kNearest;
    const Result near = run(tin, alone);
    alone.mode = Mode::kHeight;
    const Result high = run(tin, alone);
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const bool seen = one.visible[cell] == Verdict::kVisible;
      ASSERT_EQ(sees(which, cell, i), seen) << "observer " << i << " cell " << cell;
      if (one.visible[cell] == Verdict::kOutside) continue;
      if (counted[cell] == kCountOutside) counted[cell] = 0;
      least[cell] = std::min(least[cell], high.get<LeastHeights>().height_m[cell]);
      if (!seen) continue;
      ++counted[cell];
      greatest[cell] = std::max(greatest[cell], one.get<Angles>().angle_deg[cell]);
      distance[cell] = std::min(distance[cell], near.get<NearestObservers>().distance_m[cell]);
    }
  }
  EXPECT_EQ(count.get<Counts>().count, counted);
  std::size_t seen_cells = 0;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const bool seen = counted[cell] != kCountOutside && counted[cell] > 0;
    seen_cells += seen ? 1 : 0;
    EXPECT_EQ(visible.visible[cell] == Verdict::kVisible, seen);
    if (counted[cell] != kCountOutside) {
      EXPECT_EQ(height.get<LeastHeights>().height_m[cell], least[cell]);
    }
    if (!seen) continue;
    EXPECT_EQ(angle.get<Angles>().angle_deg[cell], greatest[cell]);
    EXPECT_EQ(nearest.get<NearestObservers>().distance_m[cell], distance[cell]);
  }
  EXPECT_GT(seen_cells, cells / 4);
}

TEST(Modes, WhichIsRefusedWhereItsBandsAreTooMany) {
  Request request;
  request.mode = Mode::kWhich;
  request.observers.assign(65535, {"", kCorner, 2});
  request.grid = RasterGrid(kCorner, 1, 1, 5000, 5000);
  try {
    run(hills(), request);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                testing::StartsWith("25000000 cells in 2048 bands, one for every 32 observers, are more"));
  }
}

TEST(Modes, AngleIsTheGreatestOfTheSightLines) {
  const Tin tin = hills();
  const Request request = strewn(5, Mode::kAngle);
  const Result result = run(tin, request);
  const std::size_t cells =
      SlowTwin(tin, request).for_each_clear_cell(result.grid, [&](std::size_t cell, const auto& sights) {
        double greatest = -std::numeric_limits<double>::infinity();
        for (const Sight& s : sights)
          if (s.verdict == Sight::kSees) greatest = std::max(greatest, s.angle_deg);
        if (std::isinf(greatest)) {
          EXPECT_TRUE(std::isnan(result.get<Angles>().angle_deg[cell]));
        } else {
          EXPECT_NEAR(result.get<Angles>().angle_deg[cell], greatest, 1e-5);
        }
        expect_classes_agree(result, cell, sights);
      });
  EXPECT_GT(cells, result.grid.cell_count() / 3);
}

TEST(Modes, NearestIsTheNearestThatSees) {
  const Tin tin = hills();
  const Request request = strewn(9, Mode::kNearest);
  const Result result = run(tin, request);
  const std::size_t cells =
      SlowTwin(tin, request).for_each_clear_cell(result.grid, [&](std::size_t cell, const auto& sights) {
        std::uint32_t nearest = 0;
        double distance = std::numeric_limits<double>::infinity();
        for (std::uint32_t i = 0; i < sights.size(); ++i)
          if (sights[i].verdict == Sight::kSees && sights[i].distance < distance)
            nearest = i + 1, distance = sights[i].distance;
        EXPECT_EQ(result.get<NearestObservers>().number[cell], nearest);
        if (nearest == 0) {
          EXPECT_TRUE(std::isnan(result.get<NearestObservers>().distance_m[cell]));
        } else {
          EXPECT_NEAR(result.get<NearestObservers>().distance_m[cell], distance, 1e-3);
        }
        expect_classes_agree(result, cell, sights);
      });
  EXPECT_GT(cells, result.grid.cell_count() / 3);
}

TEST(Modes, OfTwoAsNearTheFirstIsNearest) {
  const Tin tin = test::lattice_tin(41, 41, 10, [](std::int32_t, std::int32_t) { return 100.0; });
  Request request;
  request.mode = Mode::kNearest;
  request.cell_size = 10;
  request.observers = {{"west", {kCorner.x + 105, kCorner.y + 205}, 5},
                       {"east", {kCorner.x + 305, kCorner.y + 205}, 5}};
  const Result result = run(tin, request);
  const auto at = [&](double dx, double dy) {
    return result.get<NearestObservers>()
        .number[result.grid.index(result.grid.cell_at({kCorner.x + dx, kCorner.y + dy}).value())];
  };
  EXPECT_EQ(at(205, 205), 1U);
  EXPECT_EQ(at(205, 395), 1U);
  EXPECT_EQ(at(215, 205), 2U);
  EXPECT_EQ(at(105, 205), 1U);
}

TEST(Modes, AnObserverWithAnUnusableViewIsNamed) {
  Request request = strewn(3, Mode::kVisible);
  request.observers[2].name = "the third";
  request.observers[2].radius = -1;
  try {
    run(hills(), request);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::AllOf(::testing::HasSubstr("the third"), ::testing::HasSubstr("radius -1")));
  }
}

}  // namespace
}  // namespace itin::viewshed
