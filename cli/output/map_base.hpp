// What lies below every map sheet: the shaded relief and contours of a store's ground, or a picture given for it.
//
//   const MapBase base = map_base(store, profile::ground_in_frame(sheet), profile::scale_of(sheet), basemap, progress);
//   sheet.layers = layers_of(faded(base, studied), std::move(cells));
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <itin/store.hpp>
#include <profile/map_sheet.hpp>

namespace itin::cli {

struct MapBase {
  profile::SheetCells picture;
  std::vector<profile::SheetLayer> contours;
  std::vector<profile::SheetKey> keys;  ///< rows of the legend for contours
  std::string clear;                    ///< what the picture is clear for, in the legend; empty: for nothing
};

/// Over all of a map's frame, at 1 : scale. `basemap` is a georeferenced picture in place of the relief; empty: none.
/// Throws FileError for one that cannot be used.
MapBase map_base(const Store& store, const Box& frame, double scale, const std::string& basemap, Progress& progress);

/// The shaded relief alone, at these pixels.
MapBase plain_base(const Store& store, const RasterGrid& pixels, Progress& progress);

/// Names the picture in a title block.
std::pair<std::string, std::string> basemap_fact(const std::string& basemap);

/// Its picture faded where `studied` does not hold, which is asked about positions on any thread.
MapBase faded(MapBase base, const std::function<bool(Point2)>& studied);

/// The picture, what is shown over it, contours.
std::vector<profile::SheetLayer> layers_of(const MapBase& base, profile::SheetCells shown);

}  // namespace itin::cli
