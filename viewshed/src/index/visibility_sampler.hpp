// How much of its surroundings a place sees, from targets at random: Franklin's visibility index.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <itin/geometry.hpp>
#include <viewshed/result.hpp>

#include "index/line_tester.hpp"
#include "request/void_shadow.hpp"

namespace itin::viewshed {

class VisibilitySampler {
 public:
  struct Tally {
    unsigned asked = 0;      ///< targets within the radius
    unsigned on_ground = 0;  ///< targets asked about that have ground
    unsigned seen = 0;       ///< targets on ground that are seen
    unsigned undecided = 0;  ///< targets that ground without data alone could hide
  };

  /// The targets of every eye.
  struct Targets {
    double radius = 0;  ///< metres
    double height = 0;  ///< metres above the ground
    unsigned count = 0;
  };
  /// Targets stand on `ground`, which may be `surface` itself. Both must outlive the sampler.
  VisibilitySampler(const LineTester& surface, const LineTester& ground, const Targets& targets, NoData nodata);

  /// The ground under a place, metres.
  std::optional<double> ground(Point2 place) const;

  /// Called with every target on ground, metres: visible, hidden or undecided.
  using TargetJudged = std::function<void(Point2 target, Verdict verdict)>;
  /// Tests lines from an eye at this elevation, metres, to targets spread evenly over the disc about it. A seed always
  /// gives the same targets. Safe for concurrent use.
  Tally observe(Point2 eye, double elevation, std::uint64_t seed, const TargetJudged& on_target = nullptr) const;

 private:
  struct Target;
  std::vector<RimEdge> rim_near(const Point3& eye) const;
  std::vector<Target> draw(Point2 eye, std::uint64_t seed) const;
  void judge(const Point3& eye, const VoidShadow& behind_voids, std::span<Target> targets) const;

  const LineTester& surface_;
  const LineTester& ground_;
  Targets targets_;
  NoData rule_;
  std::vector<RimEdge> rim_;  ///< from south to north, where ground without data matters
  std::int32_t longest_ = 0;  ///< the greatest extent of its edges, from south to north
};

}  // namespace itin::viewshed
