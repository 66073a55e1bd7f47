// Routes to one place over links.
//
//   const auto leaves_by = shortest_routes(hub, places, links);   // leaves_by[hub] is empty
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace itin::viewshed {

/// A link between two places, by their numbers; it has no direction.
struct RouteLink {
  std::size_t from = 0, to = 0;
  double length = 0;

  std::size_t other_end(std::size_t end) const { return end == from ? to : from; }
};

/// Returns for each place the number of the link by which its route to the root leaves it; nothing for the root and
/// where there is no route. The route is the one of the fewest links; among those, the shortest; among those, the one
/// whose links come first.
std::vector<std::optional<std::size_t>> shortest_routes(std::size_t root, std::size_t places,
                                                        std::span<const RouteLink> links);

}  // namespace itin::viewshed
