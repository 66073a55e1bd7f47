// The base of every map sheet: the shaded relief and contours of a store's ground, or a picture given instead.
//
//   const MapBase base = map_base(store, profile::ground_in_frame(sheet), profile::scale_of(sheet), basemap, progress);
//   sheet.layers = layers_of(base, std::move(cells));
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <itin/store.hpp>
#include <profile/map_sheet.hpp>
#include <viewshed/relief.hpp>

namespace itin::viewshed {

struct MapBase {
  profile::SheetCells picture;
  std::vector<profile::SheetLayer> contours;
  std::vector<profile::SheetKey> keys;  ///< rows of the legend for contours
  std::string clear;                    ///< the legend's text for clear pixels of the picture; empty: none
};

/// Makes the base over all of a map's frame, at 1 : scale. `basemap` is a georeferenced picture in place of the relief;
/// empty if there is none. Throws FileError for a picture that cannot be used.
MapBase map_base(const Store& store, const Box& frame, double scale, const std::string& basemap, Progress& progress);

/// Makes a base of the shaded relief alone.
MapBase plain_base(const Relief& ground);

/// Names the picture in a title block.
std::pair<std::string, std::string> basemap_fact(const std::string& basemap);

/// Returns the layers: the picture, the cells shown over it, and contours.
std::vector<profile::SheetLayer> layers_of(const MapBase& base, profile::SheetCells shown);

}  // namespace itin::viewshed
