// Themes: named classes of lines in a store.
//
//   const ThemeChoice some = ThemeChoice::parse("houses,hedges");  // or "all", "none"
//   const ThemeChoice with_roads = ThemeChoice::all().with_ground_lines();
//
// Lines of terrain themes (contours, breaklines, water) have heights and are part of the full surface, whatever a query
// chooses. Lines of the other kinds lie on the surface, and are part of a query's triangulation only where the query
// names their theme and asks for lines on the ground. A theme of buildings, walls or vegetation may stand on the
// surface instead, with roofs and tops: terrain and other themes under them then make way. A theme of the kind surface
// always stands: it has all that a raster of a digital surface model shows above the ground.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace itin {

enum class ThemeKind : std::uint8_t {
  Contours,
  Breaklines,
  Water,
  Roads,
  Walls,
  Buildings,
  Vegetation,
  Surface,
  Terraces
};

/// Returns "contours", "breaklines", ...
std::string_view name_of(ThemeKind kind);
/// Returns the kind of this name. Throws InputError.
ThemeKind theme_kind(std::string_view name);
/// Tells whether lines of this kind are part of the full surface.
constexpr bool is_terrain(ThemeKind kind) {
  return kind == ThemeKind::Contours || kind == ThemeKind::Breaklines || kind == ThemeKind::Water;
}
/// Tells whether features of this kind are raised on the ground where they have heights. Each building has one base;
/// terraces (rows of houses that climb a slope), walls and vegetation follow the ground at their height above it.
constexpr bool may_be_raised(ThemeKind kind) {
  return kind == ThemeKind::Buildings || kind == ThemeKind::Terraces || kind == ThemeKind::Walls ||
         kind == ThemeKind::Vegetation || kind == ThemeKind::Surface;
}

/// The roof that closes a building above its footprint.
enum class RoofKind : std::uint8_t { flat, gabled, hipped, skeleton };
/// The place that a building's heights count from: the minimum, mean or maximum of the terrain under its footprint;
/// terrain_following takes the mean, too. The building's foot lies on the terrain whatever the rule.
enum class BaseRule : std::uint8_t { minimum, mean, maximum, terrain_following };

/// How the heights of a raster's cells become whole steps: the nearest step (the upper one of two equally near), the
/// next step that is no lower, or the next that is no higher.
enum class HeightRounding : std::uint8_t { nearest, up, down };

/// Reads "flat", "gabled", "hipped" or "skeleton". Throws InputError.
RoofKind roof_kind(std::string_view name);
/// Reads "minimum", "mean", "maximum" or "terrain-following". Throws InputError.
BaseRule base_rule(std::string_view name);
/// Reads "nearest", "up" or "down". Throws InputError.
HeightRounding height_rounding(std::string_view name);

/// The type of a field's values.
enum class AttributeType : std::uint8_t { number, whole, text };
/// Returns "number", "whole" or "text".
std::string_view name_of(AttributeType type);

/// An attribute of a theme's features, as their sources name it.
struct AttributeField {
  std::string name = {};
  AttributeType type = AttributeType::text;
  friend bool operator==(const AttributeField&, const AttributeField&) = default;
};

/// Consecutive numbers of features of a theme, both ends among them.
struct FeatureRun {
  std::int64_t first = 0, last = 0;
  friend bool operator==(const FeatureRun&, const FeatureRun&) = default;
};

struct ThemeInfo {
  std::string name;
  ThemeKind kind = ThemeKind::Breaklines;
  std::uint64_t features = 0;  ///< imported features with at least one line
  std::uint64_t vertices = 0;  ///< distinct ends of the theme's segments
  std::uint64_t segments = 0;  ///< segments in the full surface, after crossings were resolved
  /// The number of blocks that keep the theme's footprints as they were imported; 0 for lines on the ground.
  std::uint32_t footprint_blocks = 0;
  /// The number of blocks that keep ids, names and attributes of the theme's features; 0 where no import kept any.
  std::uint32_t feature_blocks = 0;
  std::vector<AttributeField> fields = {};  ///< the features' attributes, in the order in which sources bring them
  bool segments_have_features = false;      ///< each of the theme's lines knows which feature it belongs to
  /// How far within their outlines the walls of the theme's features reach their full height, metres, where an import
  /// said so; elsewhere 0.05 or two grid steps.
  std::optional<double> wall_offset = {};
  /// The footprints of a raised theme that do not stand: outside the terrain, say, or without a height. Ascending and
  /// apart from each other; empty in stores of builds that did not record them.
  std::vector<FeatureRun> left_out = {};

  /// Tells whether the feature of this number, from 0, does not stand.
  bool leaves_out(std::int64_t feature) const;
  std::uint64_t left_out_count() const;
  bool is_raised() const { return footprint_blocks > 0; }
};

/// The features of a raised theme that are present at the same tolerances: whole buildings, or none of them.
struct ThemePart {
  std::uint16_t theme = 0;  ///< the theme's number, from 1
  int coarsest = 0;         ///< the part is present at this level and finer ones
  /// Whether rings leave out, block by block, the features about which they ask for coarser levels alone. Elsewhere all
  /// features are present where any ring has them.
  bool has_clusters = false;
  friend bool operator==(const ThemePart&, const ThemePart&) = default;
};

/// Tells whether the raised theme a takes the ground of b where both are chosen. Buildings come first, then walls, then
/// vegetation, then surfaces; among equals the name decides.
bool comes_before(const ThemeInfo& a, const ThemeInfo& b);

class OmittedTops;  // declared in a header that is not installed

/// A feature of a raised theme that a query leaves out; see without_features() of feature_at.hpp.
struct OmittedFeature {
  std::uint16_t theme = 0;  ///< the theme's number, from 1
  std::int64_t number = 0;  ///< the feature's number in its theme, from 0
  std::string theme_name;   ///< the theme's name
  std::string name = {};    ///< as its source calls the feature
  std::string id = {};      ///< empty where the store has none
  friend bool operator==(const OmittedFeature&, const OmittedFeature&) = default;
};

/// The themes that a query wants besides those of the terrain. Lines that only lie on the ground (roads, and whatever
/// was imported without heights) are straight between their vertices, where the terrain is not. A surface to look over
/// therefore has none of them; they are present only where with_ground_lines() asks for them.
class ThemeChoice {
 public:
  static ThemeChoice all() { return ThemeChoice(true, {}); }
  static ThemeChoice none() { return ThemeChoice(false, {}); }
  /// Reads "all", "none", or names with commas between. Throws InputError for an empty name.
  static ThemeChoice parse(std::string_view text);
  /// Returns this choice with lines that lie on the ground taken in, too.
  ThemeChoice with_ground_lines() const;

  /// Returns this choice without its themes of vegetation: what stands that no light passes through.
  ThemeChoice without_vegetation() const;
  /// Returns this choice without these features. `tops` are their vertices in the store that they come from, and the
  /// choice is then for that store alone. without_features() makes both.
  ThemeChoice omitting(std::vector<OmittedFeature> features, std::shared_ptr<const OmittedTops> tops) const;

  /// The features that are left out, ascending by theme and number.
  const std::vector<OmittedFeature>& omitted() const { return omitted_; }
  bool omits(std::uint16_t theme, std::int64_t feature) const;
  const std::shared_ptr<const OmittedTops>& omitted_tops() const { return tops_; }

  bool includes(const ThemeInfo& theme) const;
  /// Tells whether some included theme stands on the ground.
  bool includes_raised(const std::vector<ThemeInfo>& themes) const;
  /// Throws InputError for a name that the store does not have.
  void check(const std::vector<ThemeInfo>& themes) const;
  /// Returns the names of the included themes, those of the terrain among them, in the store's order. Throws as check()
  /// does.
  std::vector<std::string> names(const std::vector<ThemeInfo>& themes) const;

 private:
  ThemeChoice(bool all, std::vector<std::string> names) : all_(all), names_(std::move(names)) {}
  bool all_;
  std::vector<std::string> names_;
  bool ground_lines_ = false, vegetation_ = true;
  std::vector<OmittedFeature> omitted_ = {};
  std::shared_ptr<const OmittedTops> tops_ = {};
};

}  // namespace itin
