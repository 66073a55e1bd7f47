// The classes of cells that maps, polygons and tables have of how many turbines are seen.
//
//   const CountClasses classes(zone, zone.bare.tip_count, zone.bare.tip_undecided);
//   if (const auto c = classes.of(cell)) ++cells[*c];
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <viewshed/turbines.hpp>

#include "turbines/value_bands.hpp"

namespace itin::viewshed {

class CountClasses {
 public:
  /// Takes those of hubs or of tips. All must outlive it.
  CountClasses(const Zone& zone, const std::vector<std::uint16_t>& counts, const std::vector<std::uint16_t>& undecided);

  /// None, then the bands of counts; and last, where the zone leaves_open(), a class of cells of which it is undecided
  /// whether any turbine is seen.
  const std::vector<ValueBand>& classes() const { return classes_; }
  bool is_undecided(std::size_t of_class) const { return of_class == undecided_class_; }
  /// The class of a cell; nothing where it has no value.
  std::optional<std::size_t> of(std::size_t cell) const;
  /// Whether ground without data leaves open how many are seen.
  bool is_open(std::size_t cell) const { return undecided_class_ && of(cell) && undecided_[cell] > 0; }

 private:
  const std::vector<std::uint16_t>&counts_, &undecided_;
  std::vector<ValueBand> classes_;
  std::optional<std::size_t> undecided_class_;
};

}  // namespace itin::viewshed
