// The zone of theoretical visibility of wind turbines: what of them is seen from every cell of a raster.
//
//   viewshed::ZoneRequest request;
//   request.turbines = {{.number = 1, .farm = "Pen y Cymoedd", .position = {290500, 202300}, .tip_height = 145,
//                        .hub_height = 90, .rotor_diameter = 110, .radius = 40000}};
//   request.cell_size = 50;
//   const viewshed::Zone zone = viewshed::survey_turbines(store, request, progress);
//
// A turbine is an upright axis from the ground to its tip. An eye stands `observer_height` metres above the bare ground
// at a cell's centre. The least height of the axis at which nothing hides it says all: the tip is seen if that is no
// higher than the tip, the hub likewise, and what lies above it is the visible height. It is exact for the surface: it
// is where the line from the eye touches a triangle. A cell within no turbine's radius, or without ground, has no
// value; a turbine counts only in cells within its own radius.
//
// What is seen is certainly seen: under NoData::kUnknown a turbine that ground without data alone could hide is
// undecided, and counts apart.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <itin/detail.hpp>
#include <itin/earth.hpp>
#include <itin/progress.hpp>
#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>
#include <itin/tin.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// Heights are metres above the ground at its foot.
struct Turbine {
  std::size_t number = 1;  ///< from 1; it has bit number - 1
  std::string name;
  std::string farm;  ///< may be empty
  Point2 position;
  double tip_height = 0;
  std::optional<double> hub_height;      ///< nothing: not known, and not counted among the hubs
  std::optional<double> rotor_diameter;  ///< nothing: not known, taken as 0
  double radius = 0;                     ///< how far it is looked for, metres
};

struct ZoneRequest {
  std::vector<Turbine> turbines;  ///< at least one; numbers differ
  double observer_height = 2;
  std::optional<double> cell_size;  ///< the cells: one of the two
  std::optional<RasterGrid> grid;
  Earth earth;
  Detail detail = Detail::tolerance(0);  ///< the surface's level of detail; not used with a Tin
  std::optional<ThemeChoice> themes;     ///< what screens; not used with a Tin; nothing: bare ground alone
  NoData nodata = NoData::kUnknown;
  /// A survey of a store may take about so many bytes: it is made in parts where the surface does not fit. The results
  /// are the same. Nothing: any.
  std::optional<std::uint64_t> memory_bytes;
  /// The greatest number of turbines in each band of maps and tables, ascending; none: bands of equal width.
  std::vector<std::size_t> count_bands;
  std::optional<Observer> radar;  ///< whose horizon is looked for besides, over bare ground
  /// A weight, not negative, for each cell of the grid, to sum up what each turbine shows of itself. Empty: no sums.
  std::vector<double> weights;
};

/// One value for each cell of the zone's grid. Floats are NaN, counts kCountOutside outside. Under NoData::kUnknown it
/// is what kBlock gives, and hub_undecided and tip_undecided are what kClear would add to the counts.
struct Visibility {
  std::vector<std::uint16_t> hub_count;
  std::vector<std::uint16_t> tip_count;
  std::vector<std::uint16_t> hub_undecided;   ///< empty unless the zone leaves_open()
  std::vector<std::uint16_t> tip_undecided;   ///< empty as that is; never less
  std::vector<std::uint32_t> turbines;        ///< tips seen: grids of 32-bit words, see turbine_bit()
  std::vector<float> visible_height_m;        ///< tip less least visible height, the greatest over the turbines; or 0
  std::vector<float> vertical_angle_deg;      ///< that the visible part of a turbine takes up, the greatest; or 0
  std::vector<float> vertical_angle_sum_deg;  ///< over all turbines
  std::vector<float> horizontal_angle_deg;    ///< the smallest arc that holds all visible rotors; or 0
  std::vector<float> horizontal_from_deg;     ///< that arc's anticlockwise end, from grid north; NaN where none is seen
  std::vector<float> horizontal_occupied_deg;  ///< how much of that arc rotors take up
  std::vector<float> share;                    ///< tips seen, of all turbines of the request
  std::vector<float> nearest_m;                ///< horizontal distance to the nearest turbine seen; NaN where none is
  /// A sum over all cells for each turbine of the request, where it has weights: visible height times the cell's
  /// weight.
  std::vector<double> height_sums_m;
};

/// Where Visibility::turbines keeps turbine `number` (from 1).
constexpr RasterBit turbine_bit(std::size_t number) {
  return raster_bit(number - 1);
}

/// A turbine that could not be placed.
struct Misplaced {
  std::size_t number = 0;
  std::string message;
};

/// Above a radar's horizon over bare ground. Under NoData::kUnknown what the radar certainly sees, as under kBlock, and
/// apart what it may see: whoever keeps turbines out of its sight has to mind both.
struct RadarView {
  double ground_m = 0;  ///< under the radar
  std::vector<float>
      height_m;  ///< per cell: the least height above its ground that is seen; NaN above 1000 m or no ground
  std::vector<double> turbine_m;  ///< what is seen of each turbine of the request, from its tip down; 0: hidden
  /// What it sees unless ground without data alone hides that; else NaN, 0. Empty where no line may cross any.
  std::vector<float> undecided_height_m;
  std::vector<double> undecided_turbine_m;
  bool crosses_voids = false;  ///< its sight lines may, as those of a Zone

  /// Whether it may be undecided what the radar sees.
  bool leaves_open() const { return !undecided_height_m.empty(); }
};

struct Zone {
  ZoneRequest request;           ///< without the misplaced turbines
  std::vector<double> ground_m;  ///< under each turbine of it
  std::vector<Misplaced> misplaced;
  RasterGrid grid;
  std::size_t words = 1;       ///< grids in Visibility::turbines
  bool crosses_voids = false;  ///< sight lines to turbines may pass over ground without data, unless it is kClear
  Visibility bare;
  std::optional<Visibility> screened;  ///< with the themes' features standing on the ground, where asked for
  std::optional<RadarView> radar;
  std::vector<std::string> warnings;
  Statistics statistics;  ///< its lines: pairs of eye and turbine

  /// Whether it may be undecided what is seen of the turbines.
  bool leaves_open() const { return crosses_voids && request.nodata == NoData::kUnknown; }
};

/// On given surfaces; `screened` may be null, and must cover what `ground` does. Turbines without ground become
/// misplaced. Cost: 0.5 microseconds per triangle and a tenth of a microsecond per line, of processor time. Memory: 80
/// bytes per triangle and 40 bytes per cell, twice with a screened surface; 170 per triangle with a radar. Where lines
/// may cross ground without data, 4 bytes more per cell, and 50 per turbine for each edge of its rim. The result
/// does not depend on the number of threads. Throws InputError (nothing to see, unusable numbers), Cancelled.
Zone survey_turbines(const Tin& ground, const Tin* screened, const ZoneRequest& request, Progress& progress);

/// On the surface of a store: one retrieval within the turbines' radii, or one per part; at full detail features are
/// read only where they may rise into a line to a turbine that the ground leaves open. Throws also what triangulate()
/// throws, and InputError where memory_bytes does not hold the rasters or some part, saying about how much that takes.
Zone survey_turbines(const Store& store, const ZoneRequest& request, Progress& progress);

}  // namespace itin::viewshed
