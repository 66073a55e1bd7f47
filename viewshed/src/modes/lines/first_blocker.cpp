#include "modes/lines/first_blocker.hpp"

#include "line/sight_line.hpp"

namespace itin::viewshed {

FirstBlocker::FirstBlocker(std::shared_ptr<const HeightPyramid> surface, const Earth& earth)
    : surface_(std::move(surface)),
      drop_(earth.drop_coefficient() * surface_->units().resolution),
      grazing_(kGrazing / surface_->units().resolution) {}

std::optional<FirstBlocker::Blocker> FirstBlocker::find(const Point3& from, const Point3& to) const {
  const SightLine line(from, to, drop_, grazing_);
  std::optional<Blocker> first;
  LineBundle bundle(line);
  surface_->search(bundle, [&](std::uint32_t triangle) {
    const auto [a, b, c] = surface_->tin().corners(triangle);
    const std::optional<double> at = line.hidden_from(a, b, c);
    if (!at || (first && (*at > first->at || (*at == first->at && triangle >= first->triangle)))) return;
    first = {triangle, *at};
    bundle.reach = *at;
  });
  return first;
}

}  // namespace itin::viewshed
