// What the WKT 2 of a CRS says of its axes and of its ellipsoid. GDAL knows that, too, but takes longer to load than
// most questions take.
#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <vector>

#include <itin/celestial_body.hpp>
#include <itin/grid_axes.hpp>

namespace itin {

namespace {

/// Returns what stands behind the name in each node with this keyword: "west,ORDER[1]..." of AXIS["westing",west,...
std::vector<std::string_view> behind_names(std::string_view wkt, std::string_view keyword) {
  std::vector<std::string_view> found;
  for (std::size_t at = wkt.find(keyword); at != std::string_view::npos; at = wkt.find(keyword, at + 1)) {
    const std::size_t name = at + keyword.size(), end = wkt.find("\",", name);
    if (end != std::string_view::npos) found.push_back(wkt.substr(end + 2));
  }
  return found;
}

}  // namespace

bool runs_east_north(const std::string& wkt) {
  const std::vector<std::string_view> axes = behind_names(wkt, "AXIS[\"");
  const auto running = [&](std::string_view direction) {
    return std::count_if(axes.begin(), axes.end(), [&](std::string_view axis) { return axis.starts_with(direction); });
  };
  // Away from a pole, both axes of a grid run to the south.
  return running("west") == 0 && running("south") != 1;
}

std::optional<Ellipsoid> ellipsoid_in(const std::string& wkt) {
  const std::vector<std::string_view> ellipsoids = behind_names(wkt, "ELLIPSOID[\"");
  if (ellipsoids.empty()) return std::nullopt;
  char* end = nullptr;
  const std::string values(ellipsoids.front().substr(0, 64));
  const double major = std::strtod(values.c_str(), &end);
  const double inverse_flattening = *end == ',' ? std::strtod(end + 1, nullptr) : 0;
  return Ellipsoid{major, inverse_flattening > 0 ? 1 / inverse_flattening : 0};
}

}  // namespace itin
