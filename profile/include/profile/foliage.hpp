// Sight through woods: how far a line runs within foliage, and how much light comes through.
//
//   const profile::StoreLine hills{.from = {310375, 183525}, .to = {322300, 190000}, .themes = ThemeChoice::all()};
//   const profile::FoliageSight sight =
//       profile::through_foliage(store, hills, {.from_height_m = 2, .to_height_m = 30}, {.leaf_area = 0.1});
//   std::cout << sight.length_m << " m of foliage, transmittance " << sight.transmittance << '\n';
//
// Foliage is what features of themes of vegetation hold between the ground and their tops, down to the ground. Of the
// light along a line exp(-k a d) comes through d metres of foliage with a square metres of leaves in each cubic metre
// (M. Monsi and T. Saeki, 1953). The extinction k is 0.5 where leaves are turned at random. Whatever else stands on the
// ground is solid.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <profile/los.hpp>

namespace itin::profile {

/// The leaf areas, square metres in each cubic metre, of a wood in leaf and in winter. That of winter is a tenth, for
/// which there is no source.
inline constexpr double kLeavesOn = 1, kLeavesOff = 0.1;

struct Foliage {
  double extinction = 0.5;           ///< k
  double leaf_area = kLeavesOn;      ///< the one of features that state none
  std::string leaf_area_field = {};  ///< the field of a theme's features with theirs; empty: none
  double least_transmittance = 0.5;  ///< what less of the light comes from is hidden

  /// Takes the leaf area from a text: "on", "off", or else the field that features have theirs in.
  void set_leaf_area(const std::string& text);
};

/// A stretch of a line within the foliage of one feature.
struct FoliageStretch {
  double from_m = 0, to_m = 0;  ///< in plan, from the first end
  double length_m = 0;          ///< along the line
  std::uint16_t theme = 0;
};

/// Radio waves through a wood, by ITU-R P.833: A = Am (1 - exp(-d g / Am)) for d metres of wood. The specific
/// attenuation g and the greatest attenuation Am are those of a table of secondary sources for 105.9 to 2117.5 MHz,
/// between whose rows they are interpolated in the logarithms.
struct WoodLoss {
  double through_db = 0;  ///< A
  /// Whether an end of the line is in the wood (section 2); then the loss is A.
  bool end_within = false;
  /// Otherwise: the diffraction over the wood as a solid obstacle, nothing where an antenna is within a feature; and
  /// what both ways lose together, as the sum of their powers. That sum is a preset in the place of section 3.
  std::optional<double> over_db;
  double loss_db = 0;
};

struct FoliageSight {
  LosReport solid;  ///< the line over everything but vegetation
  std::vector<FoliageStretch> stretches;
  double length_m = 0;
  double transmittance = 1;
  SightVerdict verdict = SightVerdict::kVisible;  ///< hidden also where too little light comes through
  std::optional<WoodLoss> loss;  ///< nothing without a frequency or foliage, and for frequencies that the table has not
};

/// Returns the stretches of the line between both antennas that lie below the surface where it is part of a theme for
/// which `vegetation`, by ProfilePoint::theme, is true. They are in order. Tops that a line only grazes (law 4) hide
/// nothing of it. O(n).
std::vector<FoliageStretch> foliage_along(const Profile& surface, const Antennas& antennas, const Earth& earth,
                                          const std::vector<bool>& vegetation);

/// The foliage that a path runs through which keeps to the ground, whatever rises and falls there.
struct PathFoliage {
  std::vector<FoliageStretch> stretches;  ///< one for each run of a theme, lengths in plan
  double length_m = 0;                    ///< in plan
  double transmittance = 1;               ///< the share of the light that would come along all of it
};

/// Analyses a line through the vegetation of `line.themes`. Throws InputError for an extinction or a leaf area that is
/// negative, for a least transmittance outside 0 to 1, and for a field that no theme of vegetation has; and what
/// analyse() throws.
FoliageSight through_foliage(const Store& store, const StoreLine& line, const LosQuery& query, const Foliage& foliage);

/// Returns the report on a line through foliage: that over everything but vegetation, with the verdict of the sight,
/// and with the foliage among its facts.
LosReport report_through(FoliageSight sight, const Foliage& foliage);

/// The JSON document that `itin los --foliage --json` prints, without the call and its outputs.
std::string json_of(const Store& store, const StoreLine& line, const FoliageSight& sight, const Foliage& foliage);

}  // namespace itin::profile
