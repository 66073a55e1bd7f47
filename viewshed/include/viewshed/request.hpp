// What a viewshed is asked for: observers, their fields of view, targets, cells, the surface, and the mode.
//
//   viewshed::Request request;
//   request.observers = {{.name = "mast", .position = {318000, 176000}, .height = 20}};
//   request.target_height = 2;
//   request.radius = 10000;
//   request.mode = viewshed::Mode::kHeight;
//
// Both ends of a sight line stand on the ground of the surface queried, without the raised features of the chosen
// themes, unless the request puts them on top of these. A cell is decided by its centre (cx, cy): the target is at
// T(cx, cy) + target_height, so one on the ground within a building is hidden. A sight line that grazes the surface
// sees (law 4).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <itin/detail.hpp>
#include <itin/earth.hpp>
#include <itin/geometry.hpp>
#include <itin/raster.hpp>
#include <itin/theme.hpp>
#include <profile/diffraction.hpp>

namespace itin::viewshed {

/// A range of angles, degrees. Azimuths are clockwise from grid north and may pass through it (350 to 10). Elevations
/// are those of the straight line after curvature and refraction, -90 to 90, upwards positive.
struct AngleRange {
  double from = 0;
  double to = 0;
};

struct Observer {
  std::string name = {};  ///< for messages and maps; may be empty
  Point2 position = {};
  double height = 2;  ///< metres above the surface, or an elevation when `absolute`
  bool absolute = false;
  // The observer's own field of view and targets, where they differ from the request's.
  std::optional<double> target_height = std::nullopt;
  std::optional<double> radius = std::nullopt;
  std::optional<double> min_radius = std::nullopt;
  std::optional<AngleRange> azimuth = std::nullopt;
  std::optional<AngleRange> elevation = std::nullopt;
  /// kLevel: the observer's own antenna. What it has takes the place of what Request::budget has of the first end's.
  profile::AimedAntenna antenna = {};
};

/// Under kUnknown a line is undecided if only ground without data could hide it. Modes that count or name observers
/// take the observers that certainly see. A value that such ground leaves open is not given.
using itin::NoData;

/// The algorithm that decides sight lines to cells. The result never depends on it.
enum class Engine {
  kAuto,   ///< whichever takes less time, as benchmarks/README.md measured it
  kSweep,  ///< a sweep of the surface about each observer
  kRays    ///< Embree's rays; not in mode kHeight, which asks more than a ray tells
};

/// The value that a cell gets from the observers that see it.
enum class Mode {
  kVisible,      ///< whether any does
  kCount,        ///< how many do
  kWhich,        ///< which do
  kAngle,        ///< the greatest elevation angle of their sight lines
  kNearest,      ///< the nearest of them, and its distance
  kBlocker,      ///< where none does, what hides the cell from the nearest observer that looks there
  kHeight,       ///< the least height above what targets stand on at which one is seen by any of them
  kProbability,  ///< how probably any of them does where heights are uncertain: the greatest of theirs
  kFresnel,      ///< whether any does with its first Fresnel zone clear
  kLoss,         ///< what a radio path loses by diffraction: of the observer with the least loss in all
  kLevel         ///< the level that a receiver in the cell gets, by a link budget: of the observer with the greatest
};

/// The errors of the surface's vertices are normal, with this standard deviation. The errors of vertices x apart are
/// correlated as exp(-x / correlation_length), or not at all where that length is 0. Between vertices errors are
/// linear, and what stands on the surface moves with it.
struct VerticalError {
  double sigma = 0;               ///< metres, positive
  double correlation_length = 0;  ///< metres
};

/// A link is clear if at least this fraction of the first Fresnel zone's radius is free of ground, everywhere.
struct FresnelCriterion {
  double wavelength = 0;  ///< metres
  double fraction = 0.6;  ///< positive, at most 1
};

struct Request {
  std::vector<Observer> observers = {};
  double target_height = 0;  ///< metres above the surface, or an elevation when `target_absolute`
  bool target_absolute = false;
  // The field of view of observers that have none of their own.
  std::optional<double> radius = {};  ///< metres; none: the whole coverage
  double min_radius = 0;
  std::optional<AngleRange> azimuth = {};
  std::optional<AngleRange> elevation = {};
  // The cells: one of the two, or neither. Then the cell size is the least of 1, 2, 5, 10, ... (or their decimal
  // fractions) metres that gives at most kDefaultCells cells per side.
  std::optional<double> cell_size = {};
  std::optional<RasterGrid> grid = {};
  double finest_default_cell = 0;  ///< metres; no finer cells are taken unasked, but where these are very few
  Earth earth = {};
  Detail detail = Detail::tolerance(0);      ///< the surface's level of detail; not used with a Tin
  ThemeChoice themes = ThemeChoice::none();  ///< raised features on the surface; not used with a Tin
  // Both ends stand on the ground without raised features, or on the surface with them. compute() takes the surface for
  // both where it is given no ground.
  bool observers_on_surface = false;
  bool targets_on_surface = false;
  NoData nodata = NoData::kUnknown;
  Engine engine = Engine::kAuto;
  Mode mode = Mode::kVisible;
  VerticalError vertical_error = {};  ///< kProbability
  FresnelCriterion fresnel = {};      ///< kFresnel: a visible cell is one whose zone is clear
  RadioPath radio = {};               ///< kLoss, kLevel; its effective radius is that of `earth`
  /// kLevel: the first end of each link is an observer, the second is in a cell. Antennas with a pattern at observers
  /// need an azimuth and a tilt, for they cannot aim at all cells; observers may have antennas of their own, as the
  /// sectors of a mast have. Multipath is of single links, and refused.
  profile::BudgetQuery budget = {};
  /// kLevel: the margins over the sensitivity between which regions and legends tell cells apart, ascending, dB;
  /// none: 0 alone. They need a sensitivity, and no value depends on them.
  std::vector<double> margins_db = {};
};

inline constexpr int kDefaultCells = 2048;

}  // namespace itin::viewshed
