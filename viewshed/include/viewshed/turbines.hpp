// The zone of theoretical visibility of wind turbines: how much of them is seen from every cell of a raster.
//
//   viewshed::ZoneRequest request;
//   request.turbines = {{.number = 1, .farm = "Pen y Cymoedd", .position = {290500, 202300}, .tip_height = 145,
//                        .hub_height = 90, .rotor_diameter = 110, .radius = 40000}};
//   request.cell_size = 50;
//   const viewshed::Zone zone = viewshed::survey_turbines(store, request, progress);
//
// A turbine is an upright axis from the ground to its tip. An eye stands `observer_height` metres above the bare ground
// at a cell's centre. All results follow from the least visible height: the lowest place of the axis that nothing
// hides. The tip is seen if the least visible height is no higher than the tip, and so is the hub if it is no higher
// than the hub. The axis above it is the visible height. The least visible height is exact for the surface: it is where
// the line from the eye touches a triangle. A cell within no turbine's radius, or without ground, has no value; a
// turbine counts only in cells within its own radius.
//
// Turbines that count as seen are certainly seen: under NoData::kUnknown a turbine that ground without data alone could
// hide is undecided, and is counted apart.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
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
#include <viewshed/result.hpp>

namespace itin::viewshed {

/// A part of the horizon, degrees clockwise from grid north.
struct Arc {
  double from = 0;
  double width = 0;
};

/// Where a turbine stands in planning. Where some are proposed and others are not, the study area is that about the
/// proposed ones, and what they add to the others is told (has_proposal()).
enum class TurbineStatus { kProposed, kInPlanning, kConsented, kExisting };

/// A wind turbine. Its heights are metres above the ground at its foot.
struct Turbine {
  std::size_t number = 1;  ///< from 1; it has bit number - 1
  std::string name = {};
  std::string farm = {};  ///< may be empty
  Point2 position = {};
  double tip_height = 0;
  std::optional<double> hub_height = {};      ///< nothing: unknown; the turbine does not count among the hubs
  std::optional<double> rotor_diameter = {};  ///< nothing: unknown, taken as 0
  double radius = 0;                          ///< the distance up to which eyes see it, metres
  std::optional<TurbineStatus> status = {};
};

/// Woods that turbines are seen through, in leaf and in winter, by the rule of profile/foliage.hpp.
struct ZoneFoliage {
  double extinction = 0.5;           ///< k
  double least_transmittance = 0.5;  ///< what less of the light comes from is hidden
};

struct ZoneRequest {
  std::vector<Turbine> turbines = {};  ///< at least one; numbers differ
  double observer_height = 2;
  std::optional<double> cell_size = {};  ///< either this, metres, or `grid` gives the cells
  std::optional<RasterGrid> grid = {};
  Earth earth = {};
  Detail detail = Detail::tolerance(0);     ///< the surface's level of detail; not used with a Tin
  std::optional<ThemeChoice> themes = {};   ///< features that screen; not used with a Tin; nothing: bare ground alone
  std::optional<ZoneFoliage> foliage = {};  ///< nothing: woods are solid; not used with a Tin
  NoData nodata = NoData::kUnknown;
  /// The bytes that a survey of a store may take, about. Where the surface does not fit into them, the survey is made
  /// in parts, with the same results. Nothing: no limit.
  std::optional<std::uint64_t> memory_bytes = {};
  /// The greatest number of turbines in each band of maps and tables, ascending; empty: bands of equal width.
  std::vector<std::size_t> count_bands = {};
  std::optional<Observer> radar = {};  ///< a radar whose horizon over bare ground is computed as well
  /// A weight, not negative, for each cell of the grid. The visible heights of each turbine are summed with these
  /// weights. Empty: no sums.
  std::vector<double> weights = {};
};

/// Tells whether some turbines are proposed, and others are not. Then cells beyond the radius of every proposed one are
/// outside, whatever is seen from them.
bool has_proposal(const std::vector<Turbine>& turbines);
inline bool has_proposal(const ZoneRequest& request) {
  return has_proposal(request.turbines);
}
/// Returns the turbines that the study area lies about: the proposed ones where there is a proposal, else all.
std::vector<Turbine> turbines_of_study_area(const ZoneRequest& request);

/// Grids with one value for each cell of the zone's grid. Outside, floats are NaN and counts kCountOutside. Under
/// NoData::kUnknown the values are those under kBlock; hub_undecided and tip_undecided are what kClear would add to the
/// counts.
struct Visibility {
  std::vector<std::uint16_t> hub_count;
  std::vector<std::uint16_t> tip_count;
  std::vector<std::uint16_t> hub_undecided;   ///< empty unless the zone leaves_open()
  std::vector<std::uint16_t> tip_undecided;   ///< empty where hub_undecided is; never less than it
  std::vector<std::uint32_t> turbines;        ///< tips seen: grids of 32-bit words, see turbine_bit()
  std::vector<std::uint32_t> hubs;            ///< hubs seen, likewise; empty unless woods are seen through
  std::vector<float> visible_height_m;        ///< tip less least visible height, the greatest; 0 if none is seen
  std::vector<float> vertical_angle_deg;      ///< angle of a turbine's visible part, the greatest; 0 if none is seen
  std::vector<float> vertical_angle_sum_deg;  ///< over all turbines
  std::vector<float> horizontal_angle_deg;    ///< the smallest arc that holds all visible rotors; 0 if none is seen
  std::vector<float> horizontal_from_deg;     ///< that arc's anticlockwise end, from grid north; NaN where none is seen
  std::vector<float> horizontal_occupied_deg;  ///< how much of that arc rotors take up
  std::vector<float> share;                    ///< tips seen, of all turbines of the request
  std::vector<float> nearest_m;                ///< horizontal distance to the nearest turbine seen; NaN where none is
  /// Sums for each turbine of the request: visible height times the cell's weight, over all cells. Empty where the
  /// request has no weights.
  std::vector<double> height_sums_m;
};

/// One of the grids of floats of a Visibility.
using ZoneQuantity = std::vector<float> Visibility::*;

/// Returns where Visibility::turbines keeps turbine `number` (from 1).
constexpr RasterBit turbine_bit(std::size_t number) {
  return raster_bit(number - 1);
}

/// How many turbines are seen through woods in one season, as Visibility has it of solid ones.
struct SeasonCounts {
  std::vector<std::uint16_t> hub_count, tip_count;
};
/// What is seen through woods in leaf, and what through the same in winter.
struct Seasons {
  SeasonCounts summer, winter;
};

/// A turbine that could not be placed.
struct Misplaced {
  std::size_t number = 0;
  std::string message;
};

/// What a radar sees above its horizon over bare ground. Under NoData::kUnknown this is what the radar certainly sees,
/// as under kBlock; what it may see is kept apart. Whoever keeps turbines out of its sight has to mind both.
struct RadarView {
  double ground_m = 0;  ///< under the radar
  std::vector<float>
      height_m;  ///< per cell: the least height above its ground that is seen; NaN above 1000 m or no ground
  std::vector<double> turbine_m;  ///< what is seen of each turbine of the request, from its tip down; 0: hidden
  /// What the radar sees unless ground without data alone hides that; else NaN (heights) and 0 (turbines). Empty where
  /// no sight line may cross such ground.
  std::vector<float> undecided_height_m;
  std::vector<double> undecided_turbine_m;
  bool crosses_voids = false;  ///< its sight lines may, as in Zone::crosses_voids

  /// Tells whether it may be undecided what the radar sees.
  bool leaves_open() const { return !undecided_height_m.empty(); }
};

class ZoneParts;

struct Zone {
  ZoneRequest request;           ///< without the misplaced turbines
  std::vector<double> ground_m;  ///< under each turbine of the request
  std::vector<Misplaced> misplaced;
  RasterGrid grid;
  std::size_t words = 1;           ///< grids in Visibility::turbines
  bool crosses_voids = false;      ///< sight lines to turbines may pass over ground without data, unless it is kClear
  std::uint64_t shadow_bytes = 0;  ///< about the memory that the survey took to tell which lines do
  Visibility bare;
  std::optional<Visibility> screened;  ///< with the themes' features standing on the ground, where asked for
  std::optional<Seasons> seasons;      ///< where woods are not solid
  std::optional<RadarView> radar;
  /// Not null: the grids of floats and of sets of turbines of `bare` and `screened` are empty, and are had from here
  /// part by part.
  std::shared_ptr<const ZoneParts> parts;
  std::vector<std::string> warnings;
  Statistics statistics;  ///< counts pairs of eye and turbine as lines

  /// Tells whether it may be undecided what is seen of the turbines.
  bool leaves_open() const { return crosses_voids && request.nodata == NoData::kUnknown; }
  /// The area of so many cells, square kilometres.
  double km2(std::uint64_t cells) const { return static_cast<double>(cells) * grid.cell_area() / 1e6; }
};

/// The cells of a zone that does not hold all that is told of them in memory, since that is much.
class ZoneParts {
 public:
  /// Takes a part: the zone of some of the cells, of which the first is here in the whole grid. `bare` and `screened`
  /// are complete, with as many words as the whole; nothing else need be.
  using Take = std::function<void(const Zone& part, RasterGrid::Cell north_west)>;

  virtual ~ZoneParts() = default;
  /// Calls take() for each part. Cells that belong to none are outside. Throws FileError where parts can no longer be
  /// read.
  virtual void for_each(const Take& take) const = 0;
};

/// Surveys the turbines on given surfaces; `screened` may be null, and must cover what `ground` does. Turbines without
/// ground become misplaced. The result does not depend on the number of threads. Cost: 0.5 microseconds per triangle
/// and a tenth of a microsecond per line, of processor time. Memory: 80 bytes per triangle and 40 bytes per cell, twice
/// with a screened surface; 170 bytes per triangle with a radar. Where lines may cross ground without data, it takes 4
/// bytes more per cell, and 50 per turbine for each edge of that ground's rim. Throws InputError (nothing to see,
/// unusable numbers), Cancelled.
Zone survey_turbines(const Tin& ground, const Tin* screened, const ZoneRequest& request, Progress& progress);

/// Surveys the turbines on the surface of a store, with one retrieval within the turbines' radii, or one per part. At
/// full detail features are read only where they may rise into a line to a turbine that the ground leaves open. Where
/// woods are seen through, zones with and without them bound what is seen, for tips and for hubs, and lines are walked
/// between the two alone. Throws
/// also what triangulate() throws, and InputError where memory_bytes does not hold the rasters or some part; its
/// message says about how much that takes.
Zone survey_turbines(const Store& store, const ZoneRequest& request, Progress& progress);

}  // namespace itin::viewshed
