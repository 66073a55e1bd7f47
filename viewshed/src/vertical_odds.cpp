#include "vertical_odds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sight_line.hpp"

namespace itin::viewshed {

namespace {

/// Of the clearance along a line, in units of sigma.
class Deviation {
 public:
  Deviation(double length, double correlation) : length_(length), correlation_(correlation), whole_(alike(length)) {}

  double at(double s) const {
    const double t = 1 - s;
    const double variance =
        1 + t * t + s * s - 2 * t * alike(s * length_) - 2 * s * alike(t * length_) + 2 * s * t * whole_;
    return std::sqrt(std::max(variance, 0.0));
  }
  /// For every s.
  static constexpr double kMost = std::numbers::sqrt2;
  double least() const { return correlation_ == 0 ? 1.2247 : 0; }  // sqrt(3/2), a hair less

 private:
  double alike(double distance) const { return correlation_ == 0 ? 0 : std::exp(-distance / correlation_); }

  double length_;
  double correlation_;
  double whole_;
};

}  // namespace

VerticalOdds::VerticalOdds(const Tin& tin, const Earth& earth, const VerticalError& error)
    : tin_(tin),
      drop_(earth.drop_coefficient() * tin.grid.resolution),
      grazing_(kGrazing / tin.grid.resolution),
      sigma_(error.sigma / tin.grid.resolution),
      correlation_(error.correlation_length / tin.grid.resolution),
      pyramid_(tin) {}

double VerticalOdds::least_margin(const Point3& from, const Point3& to, Memory& memory) const {
  const SightLine line(from, to, drop_, grazing_);
  const Deviation deviation(std::hypot(line.dx(), line.dy()), correlation_);
  double least = kSure;
  // Ground further below the line than this has more of a margin.
  Sheaf sheaf(line);
  sheaf.margin = kSure * sigma_ * Deviation::kMost;
  const auto consider = [&](std::uint32_t triangle) {
    const Triangle& t = tin_.triangles[triangle];
    line.for_each_crest(tin_.vertices[t[0]], tin_.vertices[t[1]], tin_.vertices[t[2]], [&](double s, double rise) {
      const double unit = sigma_ * deviation.at(s);
      // An end is as uncertain as the ground that it stands on: nothing is to be lost there.
      if (unit <= 1e-9 * sigma_ || -rise >= least * unit) return;
      least = std::max(-rise / unit, -kSure);
      memory = triangle;
      sheaf.margin = least <= -kSure ? -std::numeric_limits<double>::infinity()
                                     : least * sigma_ * (least > 0 ? Deviation::kMost : deviation.least());
    });
  };
  if (const Memory last = memory) consider(*last);
  pyramid_.search(sheaf, consider);
  return least;
}

double VerticalOdds::probability(double margin) {
  if (std::abs(margin) >= kSure) return margin > 0 ? 1 : 0;
  return std::erfc(-margin / std::numbers::sqrt2) / 2;
}

}  // namespace itin::viewshed
