#include "index/visibility_sampler.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <numbers>

#include <itin/grid_units.hpp>
#include <itin/same_place.hpp>

#include "bounds/boundary.hpp"
#include "line/set_bits.hpp"
#include "request/void_shadow.hpp"

namespace itin::viewshed {

namespace {

/// SplitMix64: the same numbers for the same place, whatever else is asked for.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// The next number, in [0, 1).
  double next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

std::int32_t southern_end(const RimEdge& edge) {
  return std::min(edge.from.y, edge.to.y);
}

}  // namespace

/// Lines to targets on ground; targets at the eye's own place are seen without a line.
struct VisibilitySampler::Packet {
  SightLines lines;
  std::array<Point2, SightLines::kSize> targets;  ///< metres
  unsigned on_ground = 0;                         ///< one bit per target
};

VisibilitySampler::VisibilitySampler(const SampledSurface& surface, const SampledSurface& ground,
                                     const Targets& targets, NoData nodata)
    : surface_(surface), ground_(ground), targets_(targets), rule_(nodata) {
  if (rule_ == NoData::kClear) return;
  rim_ = surface.rim();
  std::ranges::sort(rim_, {}, southern_end);
  for (const RimEdge& edge : rim_) longest_ = std::max(longest_, std::abs(edge.to.y - edge.from.y));
}

std::optional<double> VisibilitySampler::ground(Point2 place) const {
  const Grid& units = ground_.units();
  const auto height = ground_.height({easting_in_units(units, place.x), northing_in_units(units, place.y)});
  return height ? std::optional(*height * units.resolution) : std::nullopt;
}

/// Returns the part of the rim that lines within the radius may cross.
std::vector<RimEdge> VisibilitySampler::rim_near(const Point3& eye) const {
  const double reach = targets_.radius / surface_.units().resolution + 1;
  const auto first = std::ranges::lower_bound(rim_, eye.y - reach - longest_, {}, southern_end),
             last = std::ranges::upper_bound(rim_, eye.y + reach, {}, southern_end);
  std::vector<RimEdge> near;
  std::copy_if(first, last, std::back_inserter(near), [&](const RimEdge& edge) {
    const auto& [a, b] = edge;
    return std::min(a.x, b.x) <= eye.x + reach && std::max(a.x, b.x) >= eye.x - reach &&
           std::max(a.y, b.y) >= eye.y - reach;
  });
  return near;
}

VisibilitySampler::Tally VisibilitySampler::observe(Point2 eye, double elevation, std::uint64_t seed,
                                                    const TargetJudged& on_target) const {
  const Grid& units = surface_.units();
  const Point3 from{easting_in_units(units, eye.x), northing_in_units(units, eye.y), elevation / units.resolution};
  Random random(seed);
  const VoidShadow behind_voids(rim_near(from), from);
  SampledSurface::Scratch scratch;
  Tally tally;
  while (tally.asked < targets_.count) {
    Packet packet;
    packet.lines.start_at(from);
    const unsigned size = std::min<unsigned>(SightLines::kSize, targets_.count - tally.asked);
    for (unsigned i = 0; i < size; ++i) {
      const double distance = targets_.radius * std::sqrt(random.next());
      const double azimuth = 2 * std::numbers::pi * random.next();
      const Point2 target{eye.x + distance * std::sin(azimuth), eye.y + distance * std::cos(azimuth)};
      const auto height = ground(target);
      if (!height) continue;
      SightLines& lines = packet.lines;
      packet.targets[i] = target;
      packet.on_ground |= 1U << i;
      lines.to_x[i] = easting_in_units(units, target.x);
      lines.to_y[i] = northing_in_units(units, target.y);
      lines.to_z[i] = (*height + targets_.height) / units.resolution;
      if (!same_place(lines.to_x[i] - from.x, lines.to_y[i] - from.y)) lines.active |= 1U << i;
    }
    unsigned hidden = surface_.hidden(packet.lines, scratch), undecided = 0;
    for_each_bit(packet.lines.active & ~hidden, [&](unsigned i) {
      if (!behind_voids.holds(packet.lines.to_x[i], packet.lines.to_y[i])) return;
      (rule_ == NoData::kBlock ? hidden : undecided) |= 1U << i;
    });
    const unsigned seen = packet.on_ground & ~hidden & ~undecided;
    tally.asked += size;
    tally.on_ground += static_cast<unsigned>(std::popcount(packet.on_ground));
    tally.seen += static_cast<unsigned>(std::popcount(seen));
    tally.undecided += static_cast<unsigned>(std::popcount(undecided));
    if (!on_target) continue;
    for_each_bit(packet.on_ground, [&](unsigned i) {
      const unsigned bit = 1U << i;
      on_target(packet.targets[i], (seen & bit) != 0        ? Verdict::kVisible
                                   : (undecided & bit) != 0 ? Verdict::kUndecided
                                                            : Verdict::kHidden);
    });
  }
  return tally;
}

}  // namespace itin::viewshed
