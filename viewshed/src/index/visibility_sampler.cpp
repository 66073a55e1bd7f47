#include "index/visibility_sampler.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include <itin/grid_units.hpp>
#include <itin/same_place.hpp>

#include "bounds/boundary.hpp"
#include "line/set_bits.hpp"

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

/// A target on ground.
struct VisibilitySampler::Target {
  Point2 place;        ///< metres
  Point3 units;        ///< grid units
  double azimuth = 0;  ///< radians
  Verdict verdict = Verdict::kVisible;
};

VisibilitySampler::VisibilitySampler(const LineTester& surface, const LineTester& ground, const Targets& targets,
                                     NoData nodata)
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

/// Draws the targets about an eye that have ground, and sorts them by azimuth.
std::vector<VisibilitySampler::Target> VisibilitySampler::draw(Point2 eye, std::uint64_t seed) const {
  const Grid& units = surface_.units();
  Random random(seed);
  std::vector<Target> targets;
  for (unsigned i = 0; i < targets_.count; ++i) {
    const double distance = targets_.radius * std::sqrt(random.next());
    const double azimuth = 2 * std::numbers::pi * random.next();
    const Point2 place{eye.x + distance * std::sin(azimuth), eye.y + distance * std::cos(azimuth)};
    if (const auto height = ground(place))
      targets.push_back({place,
                         {easting_in_units(units, place.x), northing_in_units(units, place.y),
                          (*height + targets_.height) / units.resolution},
                         azimuth});
  }
  std::sort(targets.begin(), targets.end(), [](const Target& a, const Target& b) { return a.azimuth < b.azimuth; });
  return targets;
}

/// Decides lines to targets in similar directions, which meet the same ground.
void VisibilitySampler::judge(const Point3& eye, const VoidShadow& behind_voids, std::span<Target> targets) const {
  SightLines lines;
  lines.start_at(eye);
  for (unsigned i = 0; i < targets.size(); ++i) {
    const Point3& to = targets[i].units;
    lines.to_x[i] = to.x, lines.to_y[i] = to.y, lines.to_z[i] = to.z;
    // A target at the eye's own place is seen without a line.
    if (!same_place(to.x - eye.x, to.y - eye.y)) lines.active |= 1U << i;
  }
  const unsigned hidden = surface_.hidden(lines);
  for_each_bit(lines.active, [&](unsigned i) {
    Target& target = targets[i];
    if ((hidden >> i & 1) != 0) {
      target.verdict = Verdict::kHidden;
    } else if (behind_voids.holds(target.units.x, target.units.y)) {
      target.verdict = rule_ == NoData::kBlock ? Verdict::kHidden : Verdict::kUndecided;
    }
  });
}

VisibilitySampler::Tally VisibilitySampler::observe(Point2 eye, double elevation, std::uint64_t seed,
                                                    const TargetJudged& on_target) const {
  const Grid& units = surface_.units();
  const Point3 from{easting_in_units(units, eye.x), northing_in_units(units, eye.y), elevation / units.resolution};
  const VoidShadow behind_voids(rim_near(from), from);
  std::vector<Target> targets = draw(eye, seed);
  for (std::span<Target> left = targets; !left.empty();) {
    const std::span<Target> together = left.first(std::min<std::size_t>(SightLines::kSize, left.size()));
    judge(from, behind_voids, together);
    left = left.subspan(together.size());
  }
  Tally tally{targets_.count, static_cast<unsigned>(targets.size())};
  for (const Target& target : targets) {
    tally.seen += target.verdict == Verdict::kVisible ? 1 : 0;
    tally.undecided += target.verdict == Verdict::kUndecided ? 1 : 0;
    if (on_target) on_target(target.place, target.verdict);
  }
  return tally;
}

}  // namespace itin::viewshed
