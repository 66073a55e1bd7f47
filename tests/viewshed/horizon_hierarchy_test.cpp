// An eye's horizon in a hierarchy, against lines of sight over every triangle.
#include "scene/sweep/horizon_hierarchy.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <itin/earth.hpp>
#include <itin/grid_units.hpp>

#include "bounds/binned_heights.hpp"
#include "support/exact_line_of_sight.hpp"
#include "support/seed.hpp"
#include "support/terrain_tin.hpp"

namespace itin::viewshed {
namespace {

/// An eye so high above somewhere amid a surface, metres.
class Lookout {
 public:
  Lookout(const Tin& tin, const Earth& earth, double height, std::mt19937& random)
      : earth_(earth), exact_(tin, earth), bins_(tin), unit_(tin.grid.resolution), random_(random) {
    const Box box = tin.bounds();
    const Point2 foot{box.xmin + between(0.2, 0.8) * box.width(), box.ymin + between(0.2, 0.8) * box.height()};
    eye_ = {foot.x, foot.y, exact_.height(foot).value_or(0) + height};
    column_ = bins_.column_at(easting_in_units(tin.grid, eye_.x));
    row_ = bins_.row_at(northing_in_units(tin.grid, eye_.y));
  }

  /// Looks towards one side, farther and farther, at lines of these slopes.
  void look(Quadrant::Side side, double from, double to) {
    const Quadrant quadrant(bins_, column_, row_, side);
    const double bin = bins_.bin_size();
    const Sector::Axis axis{eye_.z / unit_, earth_.drop_coefficient() * unit_ * bin * bin, 1};
    HorizonHierarchy fan;
    fan.narrow(from, to);
    for (std::size_t reach = 0; reach < quadrant.slabs(); reach += 1 + random_() % 15) {
      fan.advance(quadrant, axis, reach);
      for (int i = 0; i < 4; ++i) {
        const double slope = between(from, to), least = between(from, slope), most = between(slope, to);
        const std::size_t nearest = random_() % quadrant.slabs();
        const double wide = nearest > 0 ? std::min(1.0, 1.0 / static_cast<double>(nearest)) : 1;
        const Sector::Horizon known = fan.known(std::max(least, slope - wide), std::min(most, slope + wide), nearest);
        ASSERT_LE(known.hidden.slab, std::min(nearest, reach));
        if (known.hidden.slab > 0) expect(known, quadrant, slope);
      }
    }
  }

  int hidden() const { return hidden_; }
  int clear() const { return clear_; }

 private:
  double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }

  void expect(const Sector::Horizon& known, const Quadrant& quadrant, double slope) {
    // To where the slab begins, or a hair nearer: the ground may begin with it. Rising so much per bin.
    const auto clearance = [&](double rise, double share) {
      const double along = share * quadrant.begin(known.hidden.slab), metres = bins_.bin_size() * unit_;
      const Point2 at = quadrant.position(along, slope * along);
      const double east = (at.x - column_) * metres, north = (row_ - at.y) * metres;
      const double drop = earth_.drop_coefficient() * (east * east + north * north);
      return exact_.clearance(eye_, {eye_.x + east, eye_.y + north, eye_.z + rise * along * unit_ + drop});
    };
    EXPECT_LE(known.hidden.below, known.above);
    if (std::isfinite(known.hidden.below)) {
      EXPECT_LT(clearance(known.hidden.below, 1), 0);
      ++hidden_;
    }
    if (std::isfinite(known.above)) {
      EXPECT_GE(clearance(known.above, 1 - 1e-9), 0);
      ++clear_;
    }
  }

  Earth earth_;
  test::ExactLineOfSight exact_;
  BinnedHeights bins_;
  double unit_;
  std::mt19937& random_;
  Point3 eye_;
  double column_ = 0, row_ = 0;
  int hidden_ = 0, clear_ = 0;
};

TEST(HorizonHierarchy, TellsWhatIsHiddenAndWhatIsClear) {
  std::mt19937 random(test::seed());
  const std::vector<double> z = test::fractal_heights(129, 60, 0.5, random());
  const auto height_at = [&](std::int32_t c, std::int32_t r) {
    return z[static_cast<std::size_t>(r) * 129 + static_cast<std::size_t>(c)];
  };
  const Tin whole = test::lattice_tin(129, 129, 400, height_at);
  const Tin holed = test::lattice_tin(129, 129, 50, [&](std::int32_t c, std::int32_t r) {
    return (c / 12 + r / 12) % 5 == 0 && (c - 64) * (r - 64) > 0 ? NAN : height_at(c, r);
  });
  int hidden = 0, clear = 0;
  for (const Tin* tin : {&whole, &holed}) {
    for (const auto& [refraction, height] : {std::pair{0.13, 2.0}, {0.13, 60.0}, {1.4, 20.0}}) {
      Earth earth;
      earth.refraction = refraction;
      Lookout eye(*tin, earth, height, random);
      for (const Quadrant::Side side : {Quadrant::kEast, Quadrant::kWest, Quadrant::kSouth, Quadrant::kNorth}) {
        eye.look(side, -1, 1);
        eye.look(side, -0.1, 0.3);
      }
      hidden += eye.hidden(), clear += eye.clear();
    }
  }
  EXPECT_GT(hidden, 100);
  EXPECT_GT(clear, 100);
}

}  // namespace
}  // namespace itin::viewshed
