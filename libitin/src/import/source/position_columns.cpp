#include <algorithm>
#include <cctype>

#include <itin/position_columns.hpp>

namespace itin {

namespace {

struct PositionNames {
  const char *x, *y;
  bool geographic = false;
};

constexpr PositionNames kPositionNames[] = {
    {"x", "y"},           {"easting", "northing"}, {"eastings", "northings"}, {"east", "north"},
    {"e", "n"},           {"x_coord", "y_coord"},  {"xcoord", "ycoord"},      {"point_x", "point_y"},
    {"lon", "lat", true}, {"long", "lat", true},   {"lng", "lat", true},      {"longitude", "latitude", true},
};

}  // namespace

bool same_column_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char p, unsigned char q) { return std::tolower(p) == std::tolower(q); });
}

std::optional<PositionColumns> position_columns(const std::vector<std::string>& names, std::string_view suffix) {
  const auto index_of = [&](const char* name) -> std::optional<std::size_t> {
    const std::string wanted = name + std::string(suffix);
    const auto found =
        std::find_if(names.begin(), names.end(), [&](const std::string& n) { return same_column_name(n, wanted); });
    if (found == names.end()) return std::nullopt;
    return static_cast<std::size_t>(found - names.begin());
  };
  for (const PositionNames& pair : kPositionNames) {
    const auto x = index_of(pair.x), y = index_of(pair.y);
    if (x && y) return PositionColumns{*x, *y, pair.geographic};
  }
  return std::nullopt;
}

}  // namespace itin
