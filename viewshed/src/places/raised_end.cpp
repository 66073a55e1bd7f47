#include "places/raised_end.hpp"

namespace itin::viewshed {

ClearedEnd raised_end(const PlacedSurface& surface, const SightLine& line) {
  ClearedEnd end{line.to_z()};
  LineBundle bundle(line);
  surface.pyramid->search(bundle, [&](std::uint32_t triangle) {
    const auto [a, b, c] = surface.pyramid->corners(triangle);
    const double needed = line.clearing_end(a, b, c);
    if (needed > end.z) end = {needed, triangle}, bundle.end = needed;
  });
  return end;
}

}  // namespace itin::viewshed
