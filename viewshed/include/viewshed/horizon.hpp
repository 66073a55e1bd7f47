// The horizon of an observer: how high the surface reaches in every direction, and where; and which named places are in
// sight.
//
//   const Tin tin = triangulate(store, Window::disc({310375, 183525}, 20000), Detail::tolerance(0), progress);
//   viewshed::Request request;
//   request.observers = {{"Garth Hill", {310375, 183525}, 2}};
//   const viewshed::Horizon sky = viewshed::horizon(tin, tin, request, {.step_deg = 0.1}, progress);
//   if (sky.points[900].sky) std::cout << sky.points[900].sky->elevation_deg << " degrees due east\n";
//
// Azimuths are clockwise from grid north. Elevations are those of the straight line after curvature and refraction. The
// horizon is exact: the line at an azimuth's elevation touches the surface within a micrometre and rises nowhere into
// it; nothing is sampled along it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <itin/store.hpp>
#include <viewshed/result_files.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

struct HorizonTarget {
  std::string name = {};
  Point2 position = {};
  double height = 0;        ///< metres above the ground, or an elevation when `absolute`
  std::string source = {};  ///< where it was read, for messages, such as "peaks.csv: feature 7"; or empty
  bool absolute = false;
};

struct HorizonOptions {
  double step_deg = 0.1;  ///< between azimuths: a whole number of steps makes a turn
  std::vector<HorizonTarget> targets = {};
};

struct SkyPoint {
  double elevation_deg = 0;
  double distance_m = 0;    ///< horizontal
  Point3 position;          ///< on the surface; the nearest of several places
  std::uint16_t theme = 0;  ///< the theme of the raised feature there; 0: terrain
  bool data_edge = false;   ///< the ground ends there: what lies behind, unknown, may rise higher
};

struct HorizonPoint {
  double azimuth_deg = 0;       ///< 0 to 360
  std::optional<SkyPoint> sky;  ///< nothing where there is no ground in that direction
  bool over_missing = false;    ///< ground is missing before the sky's point, and may rise higher
};

struct SightedTarget {
  HorizonTarget target;
  double elevation_m = 0;  ///< the elevation of the target
  double azimuth_deg = 0;
  double elevation_deg = 0;
  double distance_m = 0;
  Verdict verdict = Verdict::kHidden;  ///< in line of sight or not, whatever the field of view; or undecided
};

/// Throws InputError for a step that makes no turn, or is not from 0.001 to 90 degrees.
void require_whole_turn(double step_deg);

struct Horizon {
  double eye_elevation_m = 0;
  std::vector<HorizonPoint> points;  ///< from the start of the observer's azimuths, or from north, clockwise
  std::vector<SightedTarget> targets;
};

/// Computes the horizon of the request's one observer, on `surface` as far as its radius. Observer and targets stand on
/// `ground` unless the request says on the surface. Lines pass over missing ground. Cost: a few microseconds per
/// azimuth, besides 0.1 microseconds per triangle. Throws InputError (as require_whole_turn() does; an observer or
/// target outside the data, an observer beneath a roof), Cancelled.
Horizon horizon(const Tin& surface, const Tin& ground, const Request& request, const HorizonOptions& options,
                Progress& progress);

/// Computes the horizon on the surface of a store at `request.detail` with `request.themes`. `request.nodata` tells
/// what is known of lines over missing ground: targets are as a cross-section along their line has them. Reads as much
/// at once as the memory holds, one wedge of directions after another, and at least one direction. Otherwise the answer
/// is that of the function above to the last bit. Also throws what triangulate() throws.
Horizon horizon(const Store& store, const Request& request, const HorizonOptions& options,
                const ComputeOptions& compute_options, Progress& progress);

/// Computes the same, but does not read again the surface that a viewshed of the request was computed over, if it is
/// held as a whole and the memory holds its triangles.
Horizon horizon(const Store& store, ViewshedWithSurface& computed, const Request& request,
                const HorizonOptions& options, const ComputeOptions& compute_options, Progress& progress);

/// The document that `itin viewshed --horizon FILE.json` writes, for the request that the horizon was computed for.
/// `metadata` is that of the store that the surface was read from.
std::string json_of(const Horizon& horizon, const Request& request, const StoreMetadata& metadata);

}  // namespace itin::viewshed
