#include "lines/fresnel_lack.hpp"

#include <algorithm>
#include <cmath>

#include "lines/ground_pieces.hpp"

namespace itin::profile {

namespace {

/// The greatest lack, over all places considered, of clearance to `wanted` sqrt(t (1 - t)).
class GreatestLack {
 public:
  explicit GreatestLack(double wanted) : wanted_(wanted) {}

  void consider(double t, double clearance) {
    if (const double lack = wanted_ * std::sqrt(t * (1 - t)) - clearance; lack > lack_) lack_ = lack, t_ = t;
  }
  /// Considers the places between the piece's ends. The lack is concave there: the clearance over straight ground is a
  /// parabola that opens upwards, and the wanted radius half an ellipse. So it is greatest where its slope is 0.
  void consider_inside(const ClearancePiece& p) {
    if (most_along(p) <= lack_) return;
    double low = p.from, high = p.to;
    for (double middle = low + (high - low) / 2; middle > low && middle < high; middle = low + (high - low) / 2)
      (slope(p, middle) > 0 ? low : high) = middle;
    consider(low, p.at(low));
  }

  double lack() const { return lack_; }
  double t() const { return t_; }

 private:
  double slope(const ClearancePiece& p, double t) const {
    return wanted_ * (1 - 2 * t) / (2 * std::sqrt(t * (1 - t))) - p.linear - 2 * p.square * t;
  }
  /// Returns a bound on the lack along the piece. Most pieces are below the greatest so far, and need no search.
  double most_along(const ClearancePiece& p) const {
    const double sag = std::max(p.square, 0.0) * (p.to - p.from) * (p.to - p.from) / 4;
    const double widest = std::clamp(0.5, p.from, p.to);
    return wanted_ * std::sqrt(widest * (1 - widest)) - std::min(p.at(p.from), p.at(p.to)) + sag;
  }

  double wanted_;
  double lack_ = 0, t_ = 0;
};

}  // namespace

std::optional<FresnelLack> fresnel_lack(const Profile& profile, const Antennas& antennas, const Earth& earth,
                                        double fraction, double wavelength) {
  const double length = profile.length_m;
  if (!profile.has_length()) return std::nullopt;
  GreatestLack greatest(fraction * std::sqrt(wavelength * length));
  const LineOverGround line(antennas.from_m, antennas.to_m, 1, earth.drop_coefficient() * length * length);
  for (const ProfilePoint& p : profile.points) {
    const double t = p.distance_m / length;
    greatest.consider(t, line.clearance({t, p.ground_m}));
  }
  for_each_piece(profile, antennas, earth.drop_coefficient(),
                 [&](const ClearancePiece& piece, std::size_t) { greatest.consider_inside(piece); });
  if (greatest.lack() <= 0) return std::nullopt;
  return FresnelLack{greatest.lack(), greatest.t() * length};
}

}  // namespace itin::profile
