// How much of what observers look at has no ground: no data, and so neither seen nor hidden.
//
//   const MissingGround missing = missing_ground(store, result, progress);
//   if (missing.share() > 0) std::cout << missing.text() << '\n';
//
// A raster of classes has one value for cells outside every field of view and for cells without ground. This source
// tells them apart. Where the request names no cells, the raster is cut to the data, so that cells beyond it are
// counted, too.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/result.hpp>
#include <viewshed/turbines.hpp>
#include <viewshed/visibility_index.hpp>

namespace itin::viewshed {

/// Counts the missing ground among what observers look at. Cells out of view by their elevation alone have ground:
/// where elevations bound the view, the coverage of the store tells which cells these are. Cells beyond the raster are
/// counted to a thousandth. Throws what triangulate() throws.
MissingGround missing_ground(const Store& store, const Result& result, Progress& progress);
/// Returns 1 for each cell of the raster where an observer looks and there is no ground, and 0 for others. Empty where
/// there is ground everywhere. Throws what triangulate() throws.
std::vector<std::uint8_t> cells_without_ground(const Store& store, const Result& result, Progress& progress);

/// Counts among the targets of all observers.
MissingGround missing_ground(const VisibilityIndex& index);

/// Counts within the radii of the turbines.
MissingGround missing_ground(const Zone& zone);
std::vector<std::uint8_t> cells_without_ground(const Zone& zone);

/// The places where observers look and there is no ground, on the raster and beyond it.
class PlacesWithoutGround {
 public:
  /// A raster with one value per cell: 1 where an observer looks and there is no ground.
  struct Cells {
    RasterGrid grid;
    std::vector<std::uint8_t> values;
  };
  explicit PlacesWithoutGround(std::vector<Cells> parts) : parts_(std::move(parts)) {}

  bool contain(Point2 place) const;

 private:
  std::vector<Cells> parts_;
};
/// Returns the places without ground. Throws what cells_without_ground() throws.
PlacesWithoutGround places_without_ground(const Store& store, const Result& result, Progress& progress);
PlacesWithoutGround places_without_ground(const Zone& zone);

}  // namespace itin::viewshed
