// What lies below every map sheet: shaded relief and contours of a store's ground.
//
//   const MapBase base = map_base(store, profile::ground_in_frame(sheet), profile::scale_of(sheet), progress);
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <itin/store.hpp>
#include <profile/map_sheet.hpp>
#include <viewshed/relief.hpp>

namespace itin::cli {

struct MapBase {
  viewshed::Relief ground;
  std::vector<profile::SheetLayer> contours;
  std::vector<profile::SheetKey> keys;  ///< of contours, and of missing ground where there is some
};

/// Over all of a map's frame, at 1 : scale.
MapBase map_base(const Store& store, const Box& frame, double scale, Progress& progress);

/// The relief in grey, faded where `studied` does not hold. `studied` is asked about positions on any thread.
profile::SheetCells shaded(const viewshed::Relief& ground, const std::function<bool(Point2)>& studied);

}  // namespace itin::cli
