// A Zone as files: rasters with QGIS styles, polygons, tables.
//
//   const viewshed::Zone zone = viewshed::survey_turbines(store, zone_request, progress);
//   for (const viewshed::ZoneFile& file :
//        viewshed::write_zone_rasters("out", zone, {.crs_wkt = store.metadata().crs_wkt}))
//     std::cout << file.name << ": " << file.what << '\n';
//
// Names: tip-count.tif, tip-count-screened.tif, tip-count-difference.tif (bare
// less screened), and so on; undecided.tif where the zone leaves_open(). Beside
// every raster lies NAME.qml.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <itin/feature_style.hpp>
#include <itin/table_columns.hpp>
#include <viewshed/turbines.hpp>
#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

struct ZoneFileOptions {
  std::string crs_wkt;
  std::vector<std::pair<std::string, std::string>> metadata;  ///< written into every raster
};

struct RadioLink {
  std::string id;
  Point2 from, to;
};

/// Radio links that rotors must stay away from (D. F. Bacon, "Fixed-link wind-turbine exclusion zone method", 2002).
struct LinkStudy {
  std::vector<RadioLink> links;
  double frequency_ghz = 0;
  double rotor_radius_m = 0;  ///< the greatest of the turbines
};

/// The classes of TurbineStatus, in its order.
inline constexpr std::array<FeatureClass, 4> kTurbineStatuses{{{"proposed", "Proposed", {213, 94, 0}},
                                                               {"in planning", "In planning", {230, 159, 0}},
                                                               {"consented", "Consented", {0, 90, 160}},
                                                               {"existing", "Existing", {60, 60, 60}}}};

/// Returns the farms of turbines in the order of their first turbines.
std::vector<std::string> farms_of(const std::vector<Turbine>& turbines);
/// Returns a colour for each of these farms, on maps, wirelines and layers alike: dark enough for thin lines, and told
/// apart with every kind of colour blindness. Where the farms are too many to be told apart, all have one colour.
std::vector<Rgba> farm_colours(const std::vector<Turbine>& turbines);

/// Returns the name of a turbine's status; empty where it is not known.
const char* planning_status(const Turbine& turbine);
/// Returns the style of a layer of turbines that has the fields planning_status and farm: in colours by their status
/// where there is a proposal, else by their farms.
std::string turbine_style(const std::vector<Turbine>& turbines);

/// Adds what a turbine is called, or how tall it is, to the columns of a table whose rows have one. `of(member)` makes
/// a column's function of a member, or a function, of a turbine. The style of turbine_style() needs the names.
template <class Row, class Of>
void add_turbine_names(std::vector<TableColumn<Row>>& columns, const Of& of, int formats_of_status) {
  columns.emplace_back("name", of(&Turbine::name), kInCsv | kInLayer);
  columns.emplace_back("farm", of(&Turbine::farm), kInCsv | kInLayer);
  columns.emplace_back("planning_status", of(planning_status), formats_of_status);
}
template <class Row, class Of>
void add_turbine_sizes(std::vector<TableColumn<Row>>& columns, const Of& of) {
  columns.emplace_back("hub_height_m", of(&Turbine::hub_height), kInCsv | kInLayer, "{:.2f}");
  columns.emplace_back("rotor_diameter_m", of(&Turbine::rotor_diameter), kInCsv | kInLayer, "{:.2f}");
  columns.emplace_back("tip_height_m", of(&Turbine::tip_height), kInCsv | kInLayer, "{:g}");
}

/// Turbines that have one colour on maps and wirelines.
struct TurbineGroup {
  std::string name;  ///< as legends have it: "Pen y Cymoedd, existing"; may be empty
  Rgba colour;
  std::vector<std::size_t> turbines;  ///< their indices, ascending
};
/// Returns the groups of turbines: farms in the order of farms_of(), with the status that all turbines of the farm
/// have; where the farms are too many to be told apart, the statuses that occur; without statuses all turbines are one
/// group.
std::vector<TurbineGroup> turbine_groups(const std::vector<Turbine>& turbines);

/// Counts the turbines whose hub height is known; others do not count among the hubs.
std::size_t known_hubs(const Zone& zone);
/// Returns whose hubs are counted where some are not known: " of 9 of 11 turbines"; empty where all are.
std::string of_known_hubs(const Zone& zone);

/// Writes the rasters of visibility, replacing existing files. Throws FileError.
std::vector<ZoneFile> write_zone_rasters(const std::string& folder, const Zone& zone, const ZoneFileOptions& options);

/// Write radar-height.tif, where the zone has a radar, with radar-height-undecided.tif where RadarView::leaves_open();
/// and link-exclusion.tif, for rotors of the study's radius, where links are given. Ground has no part in the exclusion
/// of links, so that missing ground has none either. Throw FileError.
std::vector<ZoneFile> write_radar_raster(const std::string& folder, const Zone& zone, const ZoneFileOptions& options);
std::vector<ZoneFile> write_link_raster(const std::string& folder, const Zone& zone, const ZoneFileOptions& options,
                                        const LinkStudy& study);

/// Writes the banded counts of tips, and the combinations of farms where there are several farms, as GeoPackages.
/// Counts have a class for cells from which it is undecided whether any turbine is seen. Throws FileError.
std::vector<ZoneFile> write_zone_polygons(const std::string& folder, const Zone& zone, const ZoneFileOptions& options);

/// Returns km2 by band of counts and by ring of distance to the nearest turbine, as CSV. Every cell with a value is in
/// one band and one ring. Shares are of the part of the ring that has data; the share of the ring that has data
/// follows. The last column is how much of the area leaves some turbine undecided.
std::string area_table(const Zone& zone);
/// Returns km2 over all rings by band of counts and by combination of farms, as CSV, with rows for any turbine seen and
/// for all seen. The last column is that of area_table().
std::string area_totals(const Zone& zone);

/// Returns what the values of farms.tif stand for and km2 of each, the largest first, as CSV; the undecided area has a
/// column as in area_table().
std::string combination_table(const Zone& zone);

}  // namespace itin::viewshed
