// How much of its surroundings a place sees, from targets at random: Franklin's visibility index.
#pragma once

#include <cstdint>

#include <itin/geometry.hpp>

#include "scene/rays/scene.hpp"

namespace itin::viewshed {

class VisibilitySampler {
 public:
  struct Tally {
    unsigned asked = 0;      ///< targets within the radius
    unsigned on_ground = 0;  ///< of these
    unsigned seen = 0;       ///< of those
  };

  /// Metres. Targets stand on `ground`, which may be `scene` itself; both must outlive the sampler.
  VisibilitySampler(const Scene& scene, const Scene& ground, const Grid& grid, double radius, double target_height,
                    unsigned targets)
      : scene_(scene),
        ground_(ground),
        grid_(grid),
        radius_(radius),
        target_height_(target_height),
        targets_(targets) {}

  /// From an eye at this elevation, metres, to targets spread evenly over the disc about it. The same seed gives the
  /// same targets. Safe for concurrent use.
  Tally look(Point2 eye, double elevation, std::uint64_t seed) const;

 private:
  const Scene& scene_;
  const Scene& ground_;
  Grid grid_;
  double radius_;
  double target_height_;
  unsigned targets_;
};

}  // namespace itin::viewshed
