// How much of its surroundings a place sees, from targets at random: Franklin's visibility index.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <itin/geometry.hpp>
#include <viewshed/viewshed.hpp>

#include "index/sampled_surface.hpp"

namespace itin::viewshed {

class VisibilitySampler {
 public:
  struct Tally {
    unsigned asked = 0;      ///< targets within the radius
    unsigned on_ground = 0;  ///< of these
    unsigned seen = 0;       ///< of those
  };

  /// The targets of every eye.
  struct Targets {
    double radius = 0;  ///< metres
    double height = 0;  ///< metres above the ground
    unsigned count = 0;
  };
  /// Targets stand on `ground`, which may be `surface` itself. Both must outlive the sampler.
  VisibilitySampler(const SampledSurface& surface, const SampledSurface& ground, const Targets& targets, NoData nodata);

  /// The ground under a place, metres.
  std::optional<double> ground(Point2 place) const;

  /// Called with every target on ground, metres, and whether it is seen.
  using TargetSeen = std::function<void(Point2 target, bool seen)>;
  /// Tests lines from an eye at this elevation, metres, to targets spread evenly over the disc about it. A seed always
  /// gives the same targets. Safe for concurrent use.
  Tally observe(Point2 eye, double elevation, std::uint64_t seed, const TargetSeen& on_target = nullptr) const;

 private:
  struct Packet;
  std::vector<RimEdge> rim_near(const Point3& eye) const;

  const SampledSurface& surface_;
  const SampledSurface& ground_;
  Targets targets_;
  std::vector<RimEdge> rim_;  ///< where ground without data hides
};

}  // namespace itin::viewshed
