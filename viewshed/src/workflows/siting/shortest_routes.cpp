#include "workflows/siting/shortest_routes.hpp"

#include <limits>

namespace itin::viewshed {

std::vector<std::optional<std::size_t>> shortest_routes(std::size_t root, std::size_t places,
                                                        std::span<const RouteLink> links) {
  constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();
  std::vector<std::optional<std::size_t>> leaves_by(places);
  std::vector<std::size_t> hops(places, kNever);
  std::vector<double> length(places, std::numeric_limits<double>::infinity());
  hops[root] = 0, length[root] = 0;
  bool reached = true;
  for (std::size_t hop = 1; reached; ++hop) {
    reached = false;
    for (std::size_t i = 0; i < links.size(); ++i)
      for (const std::size_t near : {links[i].from, links[i].to}) {
        const std::size_t far = links[i].other_end(near);
        const double through = length[near] + links[i].length;
        if (hops[near] != hop - 1 || hops[far] < hop || through >= length[far]) continue;
        hops[far] = hop, length[far] = through, leaves_by[far] = i;
        reached = true;
      }
  }
  return leaves_by;
}

}  // namespace itin::viewshed
