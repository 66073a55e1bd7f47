// Themes: named classes of lines in a store.
//
//   ThemeChoice::parse("roads,hedges")    // or "all", "none"
//
// Lines of terrain themes (contours, breaklines, water) have heights and are part of the full surface, whatever a query
// chooses. Those of the other kinds lie on it, and are part of a query's triangulation only where it names their theme.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace itin {

enum class ThemeKind : std::uint8_t { Contours, Breaklines, Water, Roads, Walls, Buildings, Vegetation };

/// "contours", "breaklines", ...
std::string_view name_of(ThemeKind kind);
/// The inverse. Throws InputError.
ThemeKind theme_kind(std::string_view name);
/// Whether lines of this kind are part of the full surface.
constexpr bool is_terrain(ThemeKind kind) {
  return kind == ThemeKind::Contours || kind == ThemeKind::Breaklines || kind == ThemeKind::Water;
}

struct ThemeInfo {
  std::string name;
  ThemeKind kind = ThemeKind::Breaklines;
  std::uint64_t features = 0;  ///< imported, with at least one line
  std::uint64_t vertices = 0;  ///< distinct ends of its segments
  std::uint64_t segments = 0;  ///< of the full surface, after crossings were resolved
};

/// Which themes a query wants besides those of the terrain.
class ThemeChoice {
 public:
  static ThemeChoice all() { return ThemeChoice(true, {}); }
  static ThemeChoice none() { return ThemeChoice(false, {}); }
  /// "all", "none", or names with commas between. Throws InputError for an empty name.
  static ThemeChoice parse(std::string_view text);

  bool includes(const ThemeInfo& theme) const;
  /// Throws InputError for a name that the store does not have.
  void check(const std::vector<ThemeInfo>& themes) const;
  /// The names of the themes it includes, those of the terrain with them, in the store's order. Throws as check() does.
  std::vector<std::string> names(const std::vector<ThemeInfo>& themes) const;

 private:
  ThemeChoice(bool all, std::vector<std::string> names) : all_(all), names_(std::move(names)) {}
  bool all_;
  std::vector<std::string> names_;
};

}  // namespace itin
