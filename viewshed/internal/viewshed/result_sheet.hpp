// A map of cells in colours on a sheet of paper, over relief or a picture: viewsheds, visibility, zones and sites.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <profile/map_sheet.hpp>
#include <profile/sheet_choice.hpp>
#include <viewshed/map_base.hpp>
#include <viewshed/map_image.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/result_map.hpp>
#include <viewshed/turbines.hpp>

namespace itin::viewshed {

/// The files of a map on one paper: "sheet-coverage-A3.pdf" and its picture.
std::vector<std::string> sheet_names(const std::string& map, profile::PaperSize paper);

/// Lines or marks, the lowest first, and their keys in the legend.
struct MapObjects {
  std::vector<profile::SheetLayer> layers;
  std::vector<profile::SheetKey> keys;
};

inline constexpr Rgba kMastColour{213, 94, 0, 255};
/// Masts or eyes, as all maps mark them. Those at one place, such as the sectors of a mast, share a mark and a label.
MapObjects mast_objects(const std::vector<profile::SheetMark>& masts, std::string key);

/// Tells whether an observer has a name that is more than its number.
bool is_named(const Observer& observer);
/// Returns "3 observers", or "18 observers at 6 places" where several are at one, as the sectors of a mast are.
std::string counted_observers(const std::vector<Observer>& observers);
/// The observers of a viewshed. A single one that is only a number has no label.
MapObjects observer_objects(const std::vector<Observer>& observers, const std::string& key = "");

/// Turbines, with their numbers, in the colours of turbine_groups(). The legend says of how many no hub height is known
/// where the map is one of hubs.
MapObjects turbine_objects(const std::vector<Turbine>& turbines, bool of_hubs = false);

/// The outlines of the buildings of these themes that stand in the box, exact to a tenth of a pixel in a picture 1000
/// pixels long. Buildings smaller than two pixels, which would be blots, are left out. Nothing where there are none.
/// Throws CorruptStore.
MapObjects building_objects(const Store& store, const ThemeChoice& themes, const Box& box);

/// The places where the map is striped as without ground, and what the legend says about them; both empty if there are
/// none. `there` is called on any thread.
struct MissingOnSheet {
  std::function<bool(Point2)> there;
  std::string text;
};
MissingOnSheet missing_on_sheet(PlacesWithoutGround places, const MissingGround& missing, const std::string& area);

struct ResultSheet {
  RasterGrid grid;
  Box area;             ///< the least area that the map shows, metres
  ResultMap map;        ///< colours and keys of the cells
  std::string heading;  ///< the heading over the map's keys
  /// Whether a place is part of the study; elsewhere the relief is faded. It is called on any thread.
  std::function<bool(Point2)> studied;
  std::vector<MapObjects> objects;  ///< over the cells, the lowest first
  profile::TitleBlock title;        ///< without the parts that every sheet has: coordinates, project, date
  MissingOnSheet missing = {};
  std::string outside = {};  ///< the legend's name for faded ground; empty: none
};

/// A map of this box that has objects alone, and no cells.
ResultSheet object_sheet(const Box& shown, std::vector<MapObjects> objects, profile::TitleBlock title);

/// Returns a test that holds in the grid's cells for which `studied` holds.
std::function<bool(Point2)> in_cells(const RasterGrid& grid, std::function<bool(std::size_t)> studied);

/// Says what screens on a map of a surface of this detail, and what does not.
std::string statement_of(const StoreMetadata& metadata, const ThemeChoice& themes, const Detail& detail);

/// The fact that says how exact a map's surface is.
std::pair<std::string, std::string> terrain_fact(const StoreMetadata& metadata, const Detail& detail);

/// The base faded outside the study, and striped where the study has no ground. The stripes are this far apart, pixels.
MapBase fitted(MapBase base, const ResultSheet& content, int stripes = profile::kVoidStripePixels);

/// Makes the base of a result's map on this paper. Results of one area and study may share it. Throws FileError (a
/// basemap), InputError (a scale that is too large), Cancelled.
MapBase base_of(const Store& store, const ResultSheet& content, profile::PaperSize paper,
                const profile::SheetChoice& choice, Progress& progress);

/// All layers of the result's map, the base lowest.
std::vector<profile::SheetLayer> layers_of(const MapBase& base, ResultSheet content);
/// The legend. It says which objects lie beyond the frame, given as a box of ground.
std::vector<profile::SheetKey> keys_of(const MapBase& base, const ResultSheet& content, const Box& frame);

/// Makes the sheet, for profile::draw_map_sheet().
profile::MapSheet map_sheet(const Store& store, const ResultSheet& content, const MapBase& base,
                            profile::PaperSize paper, const profile::SheetChoice& choice);

/// Returns the bytes of a .pdf or .png, by the ending of `name`. Throws what base_of() throws.
std::string draw_result_sheet(const Store& store, const ResultSheet& content, profile::PaperSize paper,
                              const profile::SheetChoice& choice, const std::string& name, Progress& progress);

/// Draws the map as a picture over a base that fills the map's area, with a panel beside it as high as it needs.
MapImage draw_result_picture(const MapBase& plain, ResultSheet content, const std::string& crs_wkt);

}  // namespace itin::viewshed
