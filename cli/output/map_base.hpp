// What lies below every map sheet: shaded relief and contours of a store's ground.
//
//   profile::MapSheet sheet = ...;              // paper, scale and area decide what is shown
//   const MapBase base = map_base(store, sheet, progress);
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <itin/store.hpp>
#include <profile/map_sheet.hpp>
#include <viewshed/relief.hpp>

namespace itin::cli {

struct MapBase {
  viewshed::Relief ground;  ///< over all of the sheet's frame
  std::vector<profile::SheetLayer> contours;
  std::vector<profile::SheetKey> keys;  ///< of contours, and of missing ground where there is some
};

MapBase map_base(const Store& store, const profile::MapSheet& sheet, Progress& progress);

/// The relief in grey, faded where `studied` does not hold. `studied` is asked about positions on any thread.
profile::SheetCells shaded(const viewshed::Relief& ground, const std::function<bool(Point2)>& studied);

}  // namespace itin::cli
