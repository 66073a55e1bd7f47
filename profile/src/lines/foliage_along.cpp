#include <algorithm>
#include <cmath>
#include <utility>

#include <profile/foliage.hpp>

#include "lines/ground_pieces.hpp"

namespace itin::profile {

namespace {

/// Returns where the line is below a piece of the surface, as fractions of the length; an empty stretch where it is
/// not. The clearance is convex, so that there is one such stretch at most.
std::pair<double, double> below(const ClearancePiece& piece) {
  const double lowest = piece.least_within(piece.from, piece.to);
  if (piece.at(lowest) >= 0) return {lowest, lowest};
  // The roots of the parabola about its lowest place; those of a straight line are at infinity on one side.
  const double a = piece.square, b = piece.linear, c = piece.constant;
  const double root = std::sqrt(std::max(0.0, b * b - 4 * a * c));
  const double q = -(b + std::copysign(root, b)) / 2;
  double first = piece.from, last = piece.to;
  for (const double r : {a > 0 ? q / a : NAN, q != 0 ? c / q : NAN}) {
    if (r > piece.from && r <= lowest) first = std::max(first, r);
    if (r < piece.to && r >= lowest) last = std::min(last, r);
  }
  return {first, last};
}

/// Whether the surface goes on as part of the same feature: its vertices off the outline are between outlines.
bool continues(const Profile& surface, std::size_t i, const FoliageStretch& before) {
  return surface.points[i].theme == before.theme && surface.points[i].distance_m == before.to_m;
}

}  // namespace

std::vector<FoliageStretch> foliage_along(const Profile& surface, const Antennas& antennas, const Earth& earth,
                                          const std::vector<bool>& vegetation) {
  std::vector<FoliageStretch> found;
  if (!surface.has_length()) return found;
  const double length = surface.length_m;
  const double slant = std::hypot(1, (antennas.to_m - antennas.from_m) / length);
  for_each_piece(surface, antennas, earth.drop_coefficient(), [&](const ClearancePiece& piece, std::size_t i) {
    const std::uint16_t theme = surface.theme_between(i);
    if (theme >= vegetation.size() || !vegetation[theme]) return;
    const auto [first, last] = below(piece);
    if (last <= first) return;
    const double from = first == piece.from ? surface.points[i].distance_m : first * length,
                 to = last == piece.to ? surface.points[i + 1].distance_m : last * length;
    if (!found.empty() && first == piece.from && continues(surface, i, found.back())) {
      found.back().to_m = to;
    } else {
      found.push_back({from, to, 0, theme});
    }
    found.back().length_m = (found.back().to_m - found.back().from_m) * slant;
  });
  return found;
}

}  // namespace itin::profile
