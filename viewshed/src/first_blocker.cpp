#include "first_blocker.hpp"

#include "sight_line.hpp"

namespace itin::viewshed {

FirstBlocker::FirstBlocker(const Tin& tin, const Earth& earth)
    : tin_(tin),
      drop_(earth.drop_coefficient() * tin.grid.resolution),
      grazing_(kGrazing / tin.grid.resolution),
      pyramid_(tin) {}

std::optional<FirstBlocker::Blocker> FirstBlocker::find(const SightLines& lines, unsigned i) const {
  const SightLine line({lines.from_x[i], lines.from_y[i], lines.from_z[i]},
                       {lines.to_x[i], lines.to_y[i], lines.to_z[i]}, drop_, grazing_);
  std::optional<Blocker> first;
  double reach = 1;
  pyramid_.search_within(line, reach, [&](std::uint32_t triangle) {
    const Triangle& t = tin_.triangles[triangle];
    const std::optional<double> at = line.hidden_from(tin_.vertices[t[0]], tin_.vertices[t[1]], tin_.vertices[t[2]]);
    if (!at || (first && (*at > first->at || (*at == first->at && triangle >= first->triangle)))) return;
    first = {triangle, *at};
    reach = *at;
  });
  return first;
}

}  // namespace itin::viewshed
