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

struct MissingGround {
  std::uint64_t without_ground = 0;  ///< cells of the raster that an observer looks at, and that have no ground
  std::uint64_t with_ground = 0;     ///< cells of the raster that an observer looks at, and that have ground
  std::uint64_t beyond = 0;          ///< cells of that size within observers' radii, but beyond the raster
  double cell_area = 0;              ///< square metres; 0 where targets at random are counted in place of cells
  bool bounded = true;               ///< the request limits how far observers look; else: as far as there is ground

  /// The share without ground of all that observers look at, 0 to 1.
  double share() const;
  double study_m2() const { return static_cast<double>(with_ground + without_ground + beyond) * cell_area; }
  double missing_m2() const { return static_cast<double>(without_ground + beyond) * cell_area; }
  /// The share as text: "12.3 %", "less than 0.1 %", "more than 99.9 %".
  std::string percent() const;
  /// The share and its area: "12.3 % (4.6 km²)"; the share alone where no cells are counted.
  std::string text() const;
  /// The text about it in a map's legend: "No ground data: 12.3 % (4.6 km²) of `area`".
  std::string key_text(const std::string& area) const;
  /// A warning that says what share of `area` has no ground, and what can be done about it; nothing where that is less
  /// than a thousandth, or the area is wherever there is ground.
  std::optional<std::string> warning(const std::string& area) const;
};

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
