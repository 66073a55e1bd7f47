// The columns of a table that hold positions: one rule for points to import, lists of sites and links.
//
//   if (const auto columns = position_columns({"name", "Lon", "Lat"})) use(columns->x, columns->y);
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace itin {

struct PositionColumns {
  std::size_t x = 0, y = 0;
  bool geographic = false;  ///< longitude and latitude, in kGeographicColumnsCrs where nothing else is said
};

inline constexpr const char* kGeographicColumnsCrs = "EPSG:4326";

/// Finds columns in pairs (x and y, easting and northing, lon and lat, and the like), in any case of letters and each
/// with `suffix`, so that x is never paired with latitude; the first pair in this order wins. Nothing where there is no
/// pair.
std::optional<PositionColumns> position_columns(const std::vector<std::string>& names, std::string_view suffix = "");

/// Tells whether names are equal in any case of letters (ASCII).
bool same_column_name(std::string_view a, std::string_view b);

/// The columns that messages ask for in a table's header.
inline constexpr const char* kPositionColumnsAdvice = "x and y, easting and northing, or lon and lat";

}  // namespace itin
