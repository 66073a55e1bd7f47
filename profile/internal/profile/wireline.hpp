// Wirelines: the terrain's silhouettes and turbines as seen from a viewpoint, to scale.
//
//   profile::WirelineQuery query;
//   query.eye = {291500, 200300}, query.eye_elevation_m = 213.4, query.from_deg = 250;
//   query.turbines = {{.label = "1", .position = {290500, 202300}, .ground_m = 480, .hub_m = 90, .tip_m = 145}};
//   const SectionSurface surface(store, Detail::tolerance(0));
//   const profile::Wireline view = profile::survey_wireline(surface, query, progress);
//   std::ofstream("view.svg") << profile::draw_wireline(view, "view.svg");
//
// The drawing is a cylinder rolled out: a degree of azimuth is as long as a degree of elevation. Seen from the distance
// that it states, with one eye level with the horizon's middle, it covers what the eye sees. Nothing is sampled along a
// line of sight; across, there is a line every `step_deg`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <itin/cross_section.hpp>
#include <itin/earth.hpp>
#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/raster.hpp>

namespace itin::profile {

/// A turbine. Heights are metres above its ground.
struct WirelineTurbine {
  std::string label;
  Point2 position;
  double ground_m = 0;
  std::optional<double> hub_m;  ///< nothing: drawn as a mast
  double tip_m = 0;
  bool seen = true;            ///< whether it is seen, and so labelled
  std::string farm;            ///< the farm that it belongs to
  double blade_deg = 0;        ///< how far a blade is turned from upright
  Rgba colour = {30, 30, 30};  ///< its farm's; dark enough for thin lines
};

struct WirelineQuery {
  std::string title;
  std::vector<std::string> notes;  ///< lines below the title
  Point2 eye;
  double eye_elevation_m = 0;
  Earth earth;
  double from_deg = 0;      ///< the field of view, clockwise from grid north
  double width_deg = 53.5;  ///< in (0, 360]
  double step_deg = 0.05;
  double reach_m = 40000;
  bool hidden_dashed = false;  ///< also draws, dashed, what the terrain hides of turbines
  std::vector<WirelineTurbine> turbines;
};

/// The terrain between two distances, as a line of elevation angles.
struct WirelineBand {
  double from_m = 0, to_m = 0;
  std::vector<float> angle_deg;  ///< the greatest, one per line of sight from left to right; NaN without ground
  std::vector<bool> crest;       ///< whether the terrain falls out of sight behind it
};

struct Wireline {
  WirelineQuery query;
  std::vector<WirelineBand> bands;  ///< from the nearest on; every turbine stands between two of them
};

/// Elevation angle of a point, degrees above the horizontal, after curvature and refraction.
double apparent_angle_deg(const Earth& earth, double distance_m, double above_eye_m);

/// Surveys a wireline. Cost: one cross-section per line of sight. Throws what SectionSurface throws, Cancelled, and
/// InputError for a field of view that makes no sense.
Wireline survey_wireline(const SectionSurface& surface, const WirelineQuery& query, Progress& progress);

/// Returns the bytes of a file: .svg, .pdf or .png by the name's ending. Equal views give equal bytes. Throws
/// InputError.
std::string draw_wireline(const Wireline& view, const std::string& path);

}  // namespace itin::profile
