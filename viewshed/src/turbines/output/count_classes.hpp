// The classes into which maps, polygons and tables sort cells by how many turbines are seen.
//
//   const CountClasses classes(zone, zone.bare, TurbinePart::kTip);
//   if (const auto c = classes.of(cell)) ++cells[*c];
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <viewshed/turbines.hpp>

#include "turbines/value_bands.hpp"

namespace itin::viewshed {

enum class TurbinePart { kHub, kTip };

/// The bands of the counts of this part that maps, rasters and tables show: up to all turbines, or all known hubs.
std::vector<ValueBand> count_bands(const Zone& zone, TurbinePart part);

class CountClasses {
 public:
  /// Takes the counts of hubs or of tips. Zone and visibility must outlive the classes.
  CountClasses(const Zone& zone, const Visibility& visibility, TurbinePart part);
  /// Does so for what is seen through woods, of which nothing is undecided.
  CountClasses(const Zone& zone, const SeasonCounts& season, TurbinePart part);

  /// Returns the classes: none seen; the bands of counts; and last, where the zone leaves_open(), the cells from which
  /// it is undecided whether any turbine is seen.
  const std::vector<ValueBand>& classes() const { return classes_; }
  /// Returns the class of a cell; nothing where the cell has no value.
  std::optional<std::size_t> of(std::size_t cell) const;
  /// Tells whether ground without data leaves open how many turbines are seen from a cell.
  bool is_open(std::size_t cell) const { return undecided_class_ && of(cell) && undecided_[cell] > 0; }

 private:
  const std::vector<std::uint16_t>&counts_, &undecided_;
  std::vector<ValueBand> classes_;
  std::optional<std::size_t> undecided_class_;
};

}  // namespace itin::viewshed
