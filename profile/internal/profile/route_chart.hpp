// A chart of what is seen along a route, as steps over its length: the numbers of hubs and tips.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace itin::profile {

struct RouteStep {
  double from_m = 0, to_m = 0;
  std::optional<std::size_t> hubs;  ///< nothing: no hub's height is known
  std::size_t tips = 0;
  std::size_t tips_undecided = 0;  ///< more of which ground without data leaves open whether they are seen
  bool known = true;               ///< whether there is ground
};

struct RouteChart {
  std::string title, note;
  std::vector<RouteStep> steps;  ///< in order along the route
  std::size_t turbines = 1;      ///< the chart's top
};

/// Returns the bytes of a file: .svg, .pdf or .png by the name's ending. Throws InputError for another ending and for
/// no steps.
std::string draw_route_chart(const RouteChart& chart, const std::string& path);

}  // namespace itin::profile
