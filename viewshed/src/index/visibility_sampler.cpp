#include "index/visibility_sampler.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include <itin/same_place.hpp>

#include "line/grid_units.hpp"

namespace itin::viewshed {

namespace {

/// SplitMix64: the same numbers for the same place, whatever else is asked for.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// In [0, 1).
  double next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

}  // namespace

VisibilitySampler::Tally VisibilitySampler::look(Point2 eye, double elevation, std::uint64_t seed) const {
  Random random(seed);
  Occluder occluder;
  Tally tally;
  const Point3 from{easting_in_units(grid_, eye.x), northing_in_units(grid_, eye.y), elevation / grid_.resolution};
  while (tally.asked < targets_) {
    SightLines lines;
    lines.start_at(from);
    const unsigned packet = std::min<unsigned>(SightLines::kSize, targets_ - tally.asked);
    for (unsigned i = 0; i < packet; ++i) {
      const double distance = radius_ * std::sqrt(random.next());
      const double azimuth = 2 * std::numbers::pi * random.next();
      const Point2 target{eye.x + distance * std::sin(azimuth), eye.y + distance * std::cos(azimuth)};
      const auto ground = ground_.ground(target);
      if (!ground) continue;
      lines.to_x[i] = easting_in_units(grid_, target.x);
      lines.to_y[i] = northing_in_units(grid_, target.y);
      if (same_place(lines.to_x[i] - from.x, lines.to_y[i] - from.y)) {
        ++tally.on_ground, ++tally.seen;
        continue;
      }
      lines.to_z[i] = (*ground + target_height_) / grid_.resolution;
      lines.active |= 1U << i;
    }
    tally.asked += packet;
    tally.on_ground += static_cast<unsigned>(std::popcount(lines.active));
    if (lines.active != 0)
      tally.seen += static_cast<unsigned>(std::popcount(lines.active & ~scene_.hidden(lines, occluder)));
  }
  return tally;
}

}  // namespace itin::viewshed
