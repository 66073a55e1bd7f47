#include <algorithm>
#include <cctype>

#include <itin/lower_case.hpp>
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

constexpr const char* kWrittenNames[] = {"position", "gridref", "grid_reference", "os_grid_reference", "os_grid_ref",
                                         "ngr",      "mgrs",    "locator",        "maidenhead"};

/// Returns the name without a unit of metres at its end.
std::string_view without_metres(std::string_view name) {
  for (const std::string_view unit : {"(m)", "[m]", "_m", " m"})
    if (name.size() > unit.size() && name.ends_with(unit)) return name.substr(0, name.size() - unit.size());
  return name;
}

/// Returns what of a name counts: letters in lower case, and digits.
std::string letters_of(std::string_view name) {
  while (name.ends_with(' ')) name.remove_suffix(1);
  std::string letters(without_metres(in_lower_case(std::string(name))));
  std::erase_if(letters, [](unsigned char c) { return c < 0x80 && std::isalnum(c) == 0; });
  return letters;
}

bool has_any(const std::string& letters, std::initializer_list<const char*> parts) {
  return std::any_of(parts.begin(), parts.end(),
                     [&](const char* part) { return letters.find(part) != std::string::npos; });
}

bool is_any(const std::string& letters, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(), [&](const char* word) { return letters == word; });
}

}  // namespace

bool same_column_name(std::string_view a, std::string_view b) {
  const std::string letters = letters_of(a);
  return !letters.empty() && letters == letters_of(b);
}

std::optional<std::size_t> column_named(const std::vector<std::string>& names, std::string_view name) {
  const auto found = std::find_if(names.begin(), names.end(), [&](const auto& n) { return same_column_name(n, name); });
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

std::optional<PositionColumns> position_columns(const std::vector<std::string>& names, std::string_view suffix) {
  for (const PositionNames& pair : kPositionNames) {
    const auto x = column_named(names, pair.x + std::string(suffix)),
               y = column_named(names, pair.y + std::string(suffix));
    if (x && y) return PositionColumns{*x, *y, pair.geographic};
  }
  return std::nullopt;
}

std::optional<std::size_t> written_column(const std::vector<std::string>& names, std::string_view suffix) {
  for (const char* name : kWrittenNames)
    if (const auto found = column_named(names, name + std::string(suffix))) return found;
  return std::nullopt;
}

bool may_hold_heights(std::string_view name) {
  const std::string letters = letters_of(name);
  return has_any(letters, {"height", "hgt", "elev", "altitude", "offseta", "amsl", "hoehe", "h\xC3\xB6he", "hauteur",
                           "altura", "altezza"}) ||
         is_any(letters, {"h", "ht", "z", "alt", "agl", "hagl", "asl", "mast", "mastht"});
}

bool may_hold_names(std::string_view name) {
  const std::string letters = letters_of(name);
  return has_any(letters, {"name"}) || is_any(letters, {"site", "label", "title"});
}

}  // namespace itin
