// How probable it is that a sight line is clear where heights are uncertain.
//
// Model. Every height of the surface has a normal error of standard deviation sigma; the errors of two places x metres
// apart have the correlation exp(-x / L), none for L = 0. Both ends of a line stand on the surface and move with it. At
// the fraction s of a line of length d the clearance c(s) then has the variance
//     sigma^2 (1 + (1 - s)^2 + s^2 - 2 (1 - s) r(s d) - 2 s r((1 - s) d) + 2 s (1 - s) r(d)),   r(x) = exp(-x / L).
// The probability given is that of the line's critical place: the least of Phi(c(s) / deviation(s)) along it, looked
// for at the ends and at the crest of every triangle's section. It is an upper bound, for the rest of the line must be
// clear too; the nearer, the more the critical place stands out.
#pragma once

#include <cstdint>
#include <optional>

#include <itin/earth.hpp>
#include <itin/tin.hpp>
#include <viewshed/viewshed.hpp>

#include "height_pyramid.hpp"

namespace itin::viewshed {

/// Safe for concurrent use.
class VerticalOdds {
 public:
  /// The Tin must outlive it. Cost and memory: HeightPyramid's.
  VerticalOdds(const Tin& tin, const Earth& earth, const VerticalError& error);

  /// The triangle of the last line's critical place: it most often is near the next one's too.
  using Memory = std::optional<std::uint32_t>;
  /// The least clearance of a line in standard deviations, from -kSure to kSure; negative where it is hidden. Ends in
  /// grid units.
  double least_margin(const Point3& from, const Point3& to, Memory& memory) const;
  static constexpr double kSure = 6;
  /// Phi: that of a margin; 1 from kSure on, 0 from -kSure down.
  static double probability(double margin);

 private:
  const Tin& tin_;
  double drop_;         ///< grid units of drop a squared grid unit
  double grazing_;      ///< grid units
  double sigma_;        ///< grid units
  double correlation_;  ///< L in grid units
  HeightPyramid pyramid_;
};

}  // namespace itin::viewshed
