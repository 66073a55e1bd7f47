#include "modes/first_blocker.hpp"

#include "line/sight_line.hpp"

namespace itin::viewshed {

FirstBlocker::FirstBlocker(const Tin& tin, const Earth& earth, const Progress& progress)
    : tin_(tin),
      drop_(earth.drop_coefficient() * tin.grid.resolution),
      grazing_(kGrazing / tin.grid.resolution),
      pyramid_(tin, progress) {}

std::optional<FirstBlocker::Blocker> FirstBlocker::find(const Point3& from, const Point3& to) const {
  const SightLine line(from, to, drop_, grazing_);
  std::optional<Blocker> first;
  LineBundle bundle(line);
  pyramid_.search(bundle, [&](std::uint32_t triangle) {
    const Triangle& t = tin_.triangles[triangle];
    const std::optional<double> at = line.hidden_from(tin_.vertices[t[0]], tin_.vertices[t[1]], tin_.vertices[t[2]]);
    if (!at || (first && (*at > first->at || (*at == first->at && triangle >= first->triangle)))) return;
    first = {triangle, *at};
    bundle.reach = *at;
  });
  return first;
}

}  // namespace itin::viewshed
