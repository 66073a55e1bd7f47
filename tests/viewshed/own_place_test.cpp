// Observers on cell centres, or nearer to them than a step of the store's grid, on posts, edges, walls and the data's
// edge: every mode and the exact line of sight say the same of every cell, and an eye's own place is seen.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>

#include <gtest/gtest.h>

#include <itin/grazing.hpp>
#include <itin/grid_units.hpp>
#include <itin/same_place.hpp>
#include <viewshed/result.hpp>

#include "bounds/boundary.hpp"
#include "support/exact_line_of_sight.hpp"
#include "support/seed.hpp"
#include "support/terrain_tin.hpp"
#include "support/viewshed_of.hpp"

namespace itin::viewshed {
namespace {

using test::run;

/// Rounding of double precision on walls a step thick, metres.
constexpr double kBisectionError = 1e-6;

/// As viewsheds have it.
Point2 placed(const Grid& grid, Point2 p) {
  return {grid.origin.x + easting_in_units(grid, p.x) * grid.resolution,
          grid.origin.y + northing_in_units(grid, p.y) * grid.resolution};
}

class WhereverTheObserverStands : public testing::Test {
 protected:
  double in(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  template <class T>
  T any_of(std::initializer_list<T> values) {
    return *(values.begin() + static_cast<std::ptrdiff_t>(random_() % values.size()));
  }

  /// Hills; flat-topped boxes with walls a step of the grid thick; ground with voids.
  Tin terrain() {
    switch (random_() % 3) {
      case 0:
        return test::fractal_tin(17, 50, any_of({0.0, 20.0, 200.0}), 0.55, random_());
      case 1:
        return test::lattice_tin(60, 60, 0.01,
                                 [](std::int32_t c, std::int32_t r) { return c % 20 < 9 && r % 30 < 17 ? 4.0 : 0.0; });
      default: {
        const std::vector<double> z = test::fractal_heights(17, 30, 0.55, random_());
        return test::lattice_tin(17, 17, 50, [&](std::int32_t c, std::int32_t r) {
          return (c / 3 + r / 4) % 4 == 1 ? NAN : z[static_cast<std::size_t>(r) * 17 + static_cast<std::size_t>(c)];
        });
      }
    }
  }

  /// On a post, an edge, the data's edge, or anywhere.
  Point2 place(const Tin& tin) {
    const Triangle& t = tin.triangles[random_() % tin.triangles.size()];
    const Point3 a = tin.point(t[0]), b = tin.point(t[1]), c = tin.point(t[2]);
    const double s = in(0, 1), rest = in(0, 1 - s);
    switch (random_() % 4) {
      case 0:
        return {a.x, a.y};
      case 1:
        return {a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)};
      case 2: {
        const std::vector<BoundaryEdge> edges = boundary_edges(tin);
        const BoundaryEdge& edge = edges[random_() % edges.size()];
        const Point3 p = tin.point(edge.from), q = tin.point(edge.to);
        return random_() % 2 == 0 ? Point2{p.x, p.y} : Point2{(p.x + q.x) / 2, (p.y + q.y) / 2};
      }
      default:
        return {a.x + s * (b.x - a.x) + rest * (c.x - a.x), a.y + s * (b.y - a.y) + rest * (c.y - a.y)};
    }
  }

  /// A little farther on than `p`, by up to three steps of the grid.
  Point2 beside(const Grid& grid, Point2 p) {
    const double steps = any_of({0.0, 0.0, 1e-9, 1e-5, 0.3, 0.9, 1.1, 3.0}), turn = in(0, 2 * std::numbers::pi);
    const double distance = steps * grid.resolution;
    return {p.x + distance * std::sin(turn), p.y + distance * std::cos(turn)};
  }

  Request look(const Tin& tin) {
    const Point2 centre = place(tin);
    Request request;
    request.observers = {{"o", beside(tin.grid, centre), any_of({0.0, 2.0, 30.0})}};
    request.target_height = any_of({0.0, 2.0, 10.0});
    request.nodata = any_of({NoData::kClear, NoData::kBlock});
    const double cell = any_of({0.004, 0.01, 0.13, 3.37, 7.93, 50.0});
    constexpr int kCells = 11;
    const double west = std::floor(in(0, kCells)) + 0.5, north = std::floor(in(0, kCells)) + 0.5;
    request.grid.emplace(Point2{centre.x - west * cell, centre.y + north * cell}, cell, cell, kCells, kCells);
    return request;
  }

  std::mt19937 random_{test::seed()};
};

/// The answer of the exact line of sight for a cell.
struct Truth {
  bool own = false;      ///< the observer's
  double clearance = 0;  ///< the clearance of its line
  double rise = 0;       ///< how far its target is above the eye
  bool doubtful() const { return !own && std::abs(clearance + kGrazing) < kBisectionError; }
  bool sees() const { return own || clearance > -kGrazing; }
};

class Asking {
 public:
  Asking(const Tin& tin, const Request& request) : tin_(tin), request_(request), exact_(tin, request.earth) {}

  /// Nothing where there is no ground, or perhaps none.
  std::optional<Truth> of(Point2 centre) const {
    const Observer& observer = request_.observers.front();
    const Point2 from = placed(tin_.grid, observer.position), to = placed(tin_.grid, centre);
    const auto stands = exact_.height(from), ground = exact_.height(to);
    if (!stands || !ground) return std::nullopt;
    Truth truth;
    truth.own = same_place(tin_.grid, from, to);
    truth.rise = *ground + request_.target_height - *stands - observer.height;
    if (!truth.own)
      truth.clearance =
          exact_.clearance({from.x, from.y, *stands + observer.height}, {to.x, to.y, *ground + request_.target_height});
    return truth;
  }

 private:
  const Tin& tin_;
  const Request& request_;
  test::ExactLineOfSight exact_;
};

/// One result per mode.
struct AllModes {
  explicit AllModes(const Tin& tin, Request request) {
    const auto in = [&](Mode mode) {
      request.mode = mode;
      return run(tin, request);
    };
    visible = in(Mode::kVisible), count = in(Mode::kCount), which = in(Mode::kWhich), angle = in(Mode::kAngle);
    nearest = in(Mode::kNearest), blocker = in(Mode::kBlocker), height = in(Mode::kHeight);
    request.vertical_error = {0.001, 0};
    probability = in(Mode::kProbability);
  }
  Result visible, count, which, angle, nearest, blocker, height, probability;

  void expect_one_verdict(std::size_t cell) const {
    const Verdict value = visible.visible[cell];
    for (const Result* other : {&count, &which, &angle, &nearest, &blocker, &height, &probability})
      EXPECT_EQ(other->visible[cell], value) << mode_name(other->request.mode);
    const bool seen = value == Verdict::kVisible;
    EXPECT_EQ(count.get<Counts>().count[cell], value == Verdict::kOutside ? kCountOutside : seen ? 1 : 0);
    EXPECT_EQ(which.get<ObserverSets>().words[cell], seen ? 1U : 0U);
    EXPECT_EQ(nearest.get<NearestObservers>().number[cell], seen ? 1U : 0U);
    EXPECT_EQ(std::isfinite(angle.get<Angles>().angle_deg[cell]), seen);
    EXPECT_EQ(std::isfinite(nearest.get<NearestObservers>().distance_m[cell]), seen);
    EXPECT_EQ(blocker.get<Blockers>().triangle[cell] != kNoBlocker, value == Verdict::kHidden);
    EXPECT_EQ(std::isfinite(probability.get<Probabilities>().probability[cell]), value != Verdict::kOutside);
    const float least = height.get<LeastHeights>().height_m[cell];
    EXPECT_FALSE(std::isinf(least));
    if (value == Verdict::kOutside) {
      EXPECT_TRUE(std::isnan(least));
    } else if (std::abs(least - height.request.target_height) > 1e-4) {
      EXPECT_EQ(least < height.request.target_height, seen) << "least height " << least;
    }
  }

  void expect_own(std::size_t cell, const Truth& truth) const {
    EXPECT_EQ(visible.visible[cell], Verdict::kVisible);
    EXPECT_EQ(height.get<LeastHeights>().height_m[cell], 0);
    EXPECT_EQ(nearest.get<NearestObservers>().distance_m[cell], 0);
    EXPECT_EQ(probability.get<Probabilities>().probability[cell], 1);
    const float angle_deg = angle.get<Angles>().angle_deg[cell];
    if (std::abs(truth.rise) > 1e-5) {
      EXPECT_EQ(angle_deg, std::copysign(90.0F, static_cast<float>(truth.rise)));
    } else {
      EXPECT_TRUE(angle_deg == 0 || std::abs(angle_deg) == 90);
    }
  }

 private:
  static std::string mode_name(Mode mode) { return "mode " + std::to_string(static_cast<int>(mode)); }
};

std::string described(const Request& request, Point2 centre) {
  std::ostringstream text;
  text.precision(17);
  const Observer& o = request.observers.front();
  text << "observer " << o.position.x << ' ' << o.position.y << " up " << o.height << ", cell " << centre.x << ' '
       << centre.y << " of " << request.grid->cell_width() << ", target " << request.target_height;
  return text.str();
}

TEST_F(WhereverTheObserverStands, AllModesAgree) {
  int own = 0, visible = 0, hidden = 0;
  const auto met_enough = [&] { return own > 20 && visible > 500 && hidden > 500; };
  // A few of a hundred seeds have hills in view that hide little.
  for (int trial = 0; (trial < 120 || !met_enough()) && trial < 1000 && !HasFailure(); ++trial) {
    const Tin tin = terrain();
    const Request request = look(tin);
    const Asking asking(tin, request);
    if (!asking.of(request.observers.front().position)) continue;
    const AllModes modes(tin, request);
    const RasterGrid& grid = modes.visible.grid;
    for (std::int64_t row = 0; row < grid.rows(); ++row) {
      for (std::int64_t column = 0; column < grid.columns(); ++column) {
        const Point2 centre = grid.centre(column, row);
        const std::size_t cell = grid.index({column, row});
        SCOPED_TRACE(described(request, centre));
        modes.expect_one_verdict(cell);
        const Verdict value = modes.visible.visible[cell];
        const auto truth = asking.of(centre);
        if (!truth || value == Verdict::kOutside) continue;
        if (truth->own) modes.expect_own(cell, *truth);
        // The exact line of sight does not know of missing ground.
        const bool behind_void =
            value == Verdict::kHidden && modes.blocker.get<Blockers>().triangle[cell] == kMissingGround;
        if (!truth->doubtful() && !behind_void) {
          EXPECT_EQ(value == Verdict::kVisible, truth->sees()) << "clearance " << truth->clearance;
        }
        ++(truth->own ? own : value == Verdict::kVisible ? visible : hidden);
      }
    }
  }
  EXPECT_TRUE(HasFailure() || met_enough()) << own << " own, " << visible << " visible, " << hidden << " hidden";
}

/// A ridge across the line hides what is behind it, though the ground lies on one side of the line only.
TEST(AlongTheEdgeOfTheGround, TheGroundBlocksTheLine) {
  for (std::int32_t edge = 1; edge < 16; ++edge) {
    for (const bool north : {false, true}) {
      const Tin tin = test::lattice_tin(17, 17, 50, [&](std::int32_t c, std::int32_t r) {
        return (north ? r < edge : r > edge) ? NAN : c == 2 ? 9.0 : 0.0;
      });
      const double y = test::kCorner.y + edge * 50;
      Request request;
      request.observers = {{"o", {test::kCorner.x + 200, y}, 2}};
      request.target_height = 2;
      request.grid.emplace(Point2{test::kCorner.x - 25, y + 25}, 50, 50, 5, 1);
      const test::ExactLineOfSight exact(tin, request.earth);
      for (int column = 0; column < 4; ++column) {
        const double x = test::kCorner.x + column * 50;
        SCOPED_TRACE(testing::Message() << "edge " << edge << ", north " << north << ", to " << x << ' ' << y);
        const double ground = exact.height({x, y}).value();
        EXPECT_EQ(exact.clearance({test::kCorner.x + 200, y, 2}, {x, y, ground + 2}) < 0, column < 2);
        EXPECT_EQ(run(tin, request).visible[static_cast<std::size_t>(column)],
                  column < 2 ? Verdict::kHidden : Verdict::kVisible);
      }
    }
  }
}

/// An observer two metres up on a plane looks at its own cell.
class OwnCell : public testing::Test {
 protected:
  void ask(Mode mode, AngleRange elevation, double target_height) {
    request_.mode = mode;
    request_.observers = {{"o", {300205 + 1e-4, 200205}, 2}};
    request_.elevation = elevation;
    request_.target_height = target_height;
    request_.earth = Earth::flat();
    request_.cell_size = 10;
    result_ = run(plane_, request_);
    cell_ = result_.grid.index(*result_.grid.cell_at({300205, 200205}));
  }

  const Tin plane_ = test::lattice_tin(41, 41, 10, [](std::int32_t, std::int32_t) { return 100.0; });
  Request request_;
  Result result_;
  std::size_t cell_ = 0;
};

TEST_F(OwnCell, LiesStraightBelowAboveOrLevel) {
  for (const auto& [height, angle] : {std::pair{0.0, -90.0F}, {5.0, 90.0F}, {2.0, 0.0F}}) {
    ask(Mode::kAngle, {-90, 90}, height);
    EXPECT_EQ(result_.get<Angles>().angle_deg[cell_], angle);
  }
}

TEST_F(OwnCell, IsInViewWhereItsElevationIs) {
  const std::vector<AngleRange> ranges{{-90, 90}, {-90, -10}, {-10, 10}, {10, 90}, {10, 20}};
  for (const AngleRange& range : ranges) {
    for (const double height : {0.0, 2.0, 5.0}) {
      SCOPED_TRACE(testing::Message() << range.from << " to " << range.to << ", target " << height);
      const bool in_view = height == 2 || (height == 0 ? range.from == -90 : range.to == 90);
      ask(Mode::kVisible, range, height);
      EXPECT_EQ(result_.visible[cell_], in_view ? Verdict::kVisible : Verdict::kOutside);
      ask(Mode::kHeight, range, height);
      EXPECT_EQ(result_.visible[cell_] == Verdict::kVisible, in_view);
      EXPECT_NEAR(result_.get<LeastHeights>().height_m[cell_], range.from == -90 ? 0 : 2, 1e-5);
    }
  }
}

/// Several cells that are nearer than a step of the grid are all the observer's own.
TEST_F(OwnCell, MayBeMany) {
  request_.target_height = 0;
  request_.observers = {{"o", {300205, 200205}, 2}};
  request_.grid.emplace(Point2{300204.98, 200205.02}, 0.002, 0.002, 20, 20);
  const Tin steep = test::lattice_tin(41, 41, 10, [](std::int32_t c, std::int32_t) { return 40.0 * (c % 2); });
  const Result result = run(steep, request_);
  int own = 0;
  for (std::int64_t row = 0; row < 20; ++row) {
    for (std::int64_t column = 0; column < 20; ++column) {
      if (!same_place(steep.grid, result.grid.centre(column, row), {300205, 200205})) continue;
      ++own;
      EXPECT_EQ(result.visible[result.grid.index({column, row})], Verdict::kVisible);
    }
  }
  EXPECT_GT(own, 60);
}

}  // namespace
}  // namespace itin::viewshed
