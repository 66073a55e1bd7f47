// The leaf areas of a store's vegetation, and what light leaves through it.
//
//   const LeafAreas leaves(store, themes, foliage);
//   const std::vector<FoliageStretch> stretches = foliage_along(surface, antennas, earth, leaves.vegetation());
//   const double share = leaves.transmittance(stretches, leaves.at(stretches, middles));
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/store.hpp>
#include <profile/foliage.hpp>

namespace itin::profile {

/// Refers to the store, which must outlive it. Safe for concurrent use.
class LeafAreas {
 public:
  /// Throws InputError as through_foliage() does, CorruptStore.
  LeafAreas(const Store& store, const ThemeChoice& themes, const Foliage& foliage);

  /// Whether a theme is of chosen vegetation, by its number; 0 is the terrain.
  const std::vector<bool>& vegetation() const { return vegetation_; }
  /// Whether features have leaf areas of their own.
  bool vary() const { return !by_feature_.empty(); }
  /// Returns the leaf area of each stretch, by a place in it. Where areas vary, the cost is that of features_at().
  std::vector<double> at(std::span<const FoliageStretch> stretches, const std::vector<Point2>& places) const;
  /// Returns the share of the light that comes through stretches of these leaf areas.
  double transmittance(std::span<const FoliageStretch> stretches, std::span<const double> leaf_areas) const;

 private:
  void read_field(std::uint16_t theme);

  const Store& store_;
  Foliage foliage_;
  std::vector<bool> vegetation_;
  std::map<std::uint16_t, std::vector<std::optional<double>>> by_feature_;  ///< by theme; of those that have the field
};

}  // namespace itin::profile
