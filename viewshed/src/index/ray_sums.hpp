// What an observer sees along all of its rays: the share of the ground that is seen, and how well that is known.
//
// A ray stands for the gap about it, halfway to its neighbours; directions within the gap lie a quarter of its width
// away on average. Where what is seen changes in proportion to that distance, the squared error of a gap is a quarter
// of the mean squared difference between neighbouring rays, and the gaps err independently. Rays see in steps of their
// looks, which adds a little. Errors in either half of a gap partly cancel, so that the error stated is rather too
// large. It is an estimate from a sample and no bound: what stands between two rays, and is narrower, is missed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace itin::viewshed {

class RaySums {
 public:
  /// Adds the next ray of the fan, clockwise: what its looks count on ground, and those of them that are seen.
  void add(double on_ground, double seen) {
    if (rays_ == 0) first_ = {on_ground, seen};
    if (rays_ > 0) differ(last_, {on_ground, seen});
    last_ = {on_ground, seen};
    on_ground_ += on_ground, seen_ += seen;
    ++rays_;
  }

  double on_ground() const { return on_ground_; }
  /// Returns what is seen of the ground, 0 to 1. Precondition of this and of the error: some look is on ground.
  double share() const { return seen_ / on_ground_; }
  /// Returns the standard error of the share, once all rays are added; `of_looks` is what looks err by
  /// (variance_of_looks()).
  double standard_error(double of_looks) const {
    RaySums closed = *this;
    closed.differ(last_, first_);
    const double p = share();
    const double differences = closed.seen_seen_ - 2 * p * closed.seen_ground_ + p * p * closed.ground_ground_;
    return std::sqrt(std::max(differences, 0.0) / 4 + of_looks) / on_ground_;
  }

  /// Returns the variance of what an observer's looks count: along each ray, where sight ends is known to one ring, the
  /// widest at worst.
  static double variance_of_looks(unsigned rays, std::uint32_t rings) {
    const double widest = 2.0 * rings - 1;
    return rays * widest * widest / 12;
  }

 private:
  struct Ray {
    double on_ground = 0, seen = 0;
  };
  void differ(const Ray& a, const Ray& b) {
    const double on_ground = b.on_ground - a.on_ground, seen = b.seen - a.seen;
    seen_seen_ += seen * seen, seen_ground_ += seen * on_ground, ground_ground_ += on_ground * on_ground;
  }

  Ray first_, last_;
  double rays_ = 0, on_ground_ = 0, seen_ = 0;
  double seen_seen_ = 0, seen_ground_ = 0, ground_ground_ = 0;  ///< products of differences between neighbours, summed
};

}  // namespace itin::viewshed
