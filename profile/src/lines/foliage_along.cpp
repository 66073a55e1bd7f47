#include <cmath>

#include <itin/grazing.hpp>
#include <profile/foliage.hpp>

#include "lines/ground_pieces.hpp"

namespace itin::profile {

namespace {

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
    const auto [first, last] = piece.above_line(kGrazing);
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
