// The columns of a table by their names: one rule for points to import, lists of sites and links.
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

/// Finds the column whose cells are positions as written_position() reads them: position, grid reference, NGR, MGRS or
/// locator, with `suffix`.
std::optional<std::size_t> written_column(const std::vector<std::string>& names, std::string_view suffix = "");

/// Tells whether names mean the same column: case (ASCII), marks, blanks and a unit of metres do not matter, so that
/// "Hub height (m)" is hub_height. Only marks and blanks are never equal.
bool same_column_name(std::string_view a, std::string_view b);

/// Returns the first column that has the same name; nothing where there is none.
std::optional<std::size_t> column_named(const std::vector<std::string>& names, std::string_view name);

/// Tells whether a column whose name nobody knows may hold heights, or the names of places.
bool may_hold_heights(std::string_view name);
bool may_hold_names(std::string_view name);

/// The columns that messages ask for in a table's header.
inline constexpr const char* kPositionColumnsAdvice = "x and y, easting and northing, or lon and lat";

}  // namespace itin
