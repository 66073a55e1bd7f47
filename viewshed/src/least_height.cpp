#include "least_height.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace itin::viewshed {

LeastHeights::LeastHeights(const Tin& tin, const Earth& earth, const Scene& scene)
    : tin_(tin),
      scene_(scene),
      drop_(earth.drop_coefficient() * tin.grid.resolution),
      grazing_(kGrazing / tin.grid.resolution),
      pyramid_(tin) {}

LeastHeights::Heights LeastHeights::find(const SightLines& lines, const Heights& lower, Memory& memory) const {
  Heights result;
  result.fill(std::numeric_limits<double>::quiet_NaN());
  unsigned open = lines.active & ~scene_.hidden(lines, memory.occluder);
  for (; open != 0; open &= open - 1) {
    const auto i = static_cast<unsigned>(std::countr_zero(open));
    result[i] = find_one(lines, i, std::min(lower[i], lines.to_z[i]), memory);
  }
  return result;
}

double LeastHeights::find_one(const SightLines& lines, unsigned i, double lower, Memory& memory) const {
  const SightLine line({lines.from_x[i], lines.from_y[i], lines.from_z[i]},
                       {lines.to_x[i], lines.to_y[i], lines.to_z[i]}, drop_, grazing_);
  double least = lower;
  const auto clear = [&](std::uint32_t triangle) {
    const Triangle& t = tin_.triangles[triangle];
    const double end = line.clearing_end(tin_.vertices[t[0]], tin_.vertices[t[1]], tin_.vertices[t[2]]);
    if (end > least) least = end, memory.silhouette = triangle;
  };
  if (memory.silhouette) clear(*memory.silhouette);
  pyramid_.search(line, least, clear);
  if (least <= lines.to_z[i]) return least;
  // Rays pass what rises above the line by less than their error bound. And what rises by less than a grazing is only
  // touched, though clearing it takes a hair more than the upper height.
  const bool hidden = scene_.hidden_between(lines, i, 0, 1);
  return hidden ? std::numeric_limits<double>::quiet_NaN() : lines.to_z[i];
}

}  // namespace itin::viewshed
