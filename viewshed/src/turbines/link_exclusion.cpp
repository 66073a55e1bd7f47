#include <algorithm>
#include <cmath>

#include <itin/earth.hpp>
#include <itin/parallel.hpp>
#include <viewshed/link_exclusion.hpp>

namespace itin::viewshed {

double second_fresnel_radius_m(double d1, double d2, double frequency_ghz) {
  return d1 + d2 > 0 ? std::sqrt(2 * wavelength_m(frequency_ghz) * d1 * d2 / (d1 + d2)) : 0;
}

double link_clearance_m(const RadioLink& link, Point2 turbine, double frequency_ghz, double rotor_radius_m) {
  const double dx = link.to.x - link.from.x, dy = link.to.y - link.from.y, length = std::hypot(dx, dy);
  const double px = turbine.x - link.from.x, py = turbine.y - link.from.y;
  const double along = length > 0 ? std::clamp((px * dx + py * dy) / (length * length), 0.0, 1.0) : 0;
  const double aside = std::hypot(px - along * dx, py - along * dy);
  return aside - second_fresnel_radius_m(along * length, (1 - along) * length, frequency_ghz) - rotor_radius_m;
}

std::vector<std::uint8_t> link_exclusion(const RasterGrid& grid, const std::vector<RadioLink>& links,
                                         double frequency_ghz, double rotor_radius_m) {
  std::vector<std::uint8_t> excluded(grid.cell_count(), kLinkClear);
  parallel_for(static_cast<std::size_t>(grid.rows()), [&](std::size_t row) {
    for (std::int64_t column = 0; column < grid.columns(); ++column) {
      const auto r = static_cast<std::int64_t>(row);
      const Point2 p = grid.centre(column, r);
      const bool inside = std::any_of(links.begin(), links.end(), [&](const RadioLink& link) {
        return link_clearance_m(link, p, frequency_ghz, rotor_radius_m) < 0;
      });
      if (inside) excluded[grid.index({column, r})] = kLinkExcluded;
    }
  });
  return excluded;
}

}  // namespace itin::viewshed
