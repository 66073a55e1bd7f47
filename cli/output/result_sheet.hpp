// A map of cells in colours on a sheet of paper, over relief or a picture: viewsheds, visibility, zones and sites.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <profile/map_sheet.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/result_map.hpp>

#include "options/sheet_options.hpp"
#include "output/map_base.hpp"

namespace itin::cli {

/// Lines or marks, the lowest first, and what stands for them in the legend.
struct MapObjects {
  std::vector<profile::SheetLayer> layers;
  std::vector<profile::SheetKey> keys;
};

inline constexpr Rgba kMastColour{213, 94, 0, 255};
/// Masts or eyes, as all maps mark them.
MapObjects mast_objects(std::vector<profile::SheetMark> masts, std::string key);

/// Where the map is striped as without ground, and what the legend says of it; both empty: nowhere.
struct MissingOnSheet {
  std::function<bool(Point2)> there;
  std::string text;
};
MissingOnSheet missing_on_sheet(viewshed::PlacesWithoutGround places, const viewshed::MissingGround& missing,
                                const std::string& area);

struct ResultSheet {
  RasterGrid grid;
  Box area;                             ///< that the map shows at least, metres
  viewshed::ResultMap map;              ///< colours and keys of the cells
  std::string heading;                  ///< heads the map's keys
  std::function<bool(Point2)> studied;  ///< whether a place is part of the study: the others' relief is faded
  std::vector<MapObjects> objects;      ///< over the cells, the lowest first
  profile::TitleBlock title;            ///< without what every sheet says: coordinates, project, date, maker
  MissingOnSheet missing = {};
  std::string outside = {};  ///< what the legend calls the ground that is faded; empty: nothing
};

/// Holds in the grid's cells of which `studied` holds.
std::function<bool(Point2)> in_cells(const RasterGrid& grid, std::function<bool(std::size_t)> studied);

/// What screens on a map of a surface of this detail, and what does not.
std::string statement_of(const StoreMetadata& metadata, const ThemeChoice& themes, const Detail& detail);

/// The fact of how exact a map's surface is.
std::pair<std::string, std::string> terrain_fact(const StoreMetadata& metadata, const Detail& detail);

/// The base faded outside the study, and striped where the study has no ground.
MapBase fitted(MapBase base, const ResultSheet& content);

/// What lies below a result's map on this paper. Results of one area and study may share it. Throws
/// FileError (a basemap), InputError (a scale that is too large), Cancelled.
MapBase base_of(const Store& store, const ResultSheet& content, profile::PaperSize paper, const SheetOptions& options,
                Progress& progress);

/// All that is drawn over such a base, the base lowest, and its legend.
std::vector<profile::SheetLayer> layers_of(const MapBase& base, const ResultSheet& content);
/// It says which objects lie beyond the frame, on the ground.
std::vector<profile::SheetKey> keys_of(const MapBase& base, const ResultSheet& content, const Box& frame);

/// The sheet, for profile::draw_map_sheet().
profile::MapSheet map_sheet(const Store& store, const ResultSheet& content, const MapBase& base,
                            profile::PaperSize paper, const SheetOptions& options);

/// The bytes of a .pdf or .png, by the ending of `name`. Throws as base_of() does.
std::string draw_result_sheet(const Store& store, const ResultSheet& content, profile::PaperSize paper,
                              const SheetOptions& options, const std::string& name, Progress& progress);

}  // namespace itin::cli
