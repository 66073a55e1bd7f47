#include <algorithm>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <itin/triangulate.hpp>
#include <viewshed/turbines.hpp>

#include "axis_sweep.hpp"
#include "binned_heights.hpp"
#include "boundary.hpp"
#include "eye.hpp"
#include "full_surface.hpp"
#include "near_ground.hpp"
#include "radar_survey.hpp"
#include "request.hpp"
#include "stopwatch.hpp"
#include "void_shadow.hpp"
#include "zone_parts.hpp"
#include "zone_request.hpp"
#include "zone_survey.hpp"

namespace itin::viewshed {

namespace {

/// What voids hide from each turbine, where they do.
std::vector<VoidShadow> shadows(const BinnedHeights& surface, const ZoneRequest& request) {
  std::vector<VoidShadow> result;
  if (request.nodata != NoData::kBlock) return result;
  for (const Turbine& t : request.turbines) {
    result.emplace_back(surface.rim(), Point3{easting_in_units(surface.units(), t.position.x),
                                              northing_in_units(surface.units(), t.position.y), 0});
  }
  return result;
}

void warn_of_voids(const Tin& tin, Zone& zone) {
  if (zone.request.nodata != NoData::kUnknown) return;
  const std::vector<RimEdge> rim = rim_of(tin, boundary_edges(tin));
  const bool crossed = std::any_of(zone.request.turbines.begin(), zone.request.turbines.end(), [&](const Turbine& t) {
    return surface_resumes(tin.grid, rim, t.position, t.radius);
  });
  if (crossed) zone.warnings.emplace_back(kVoidsWarning);
}

/// Surveys the parts of a zone, one after another.
class ZoneWork {
 public:
  ZoneWork(Zone& zone, Progress& progress) : zone_(zone), progress_(progress), tiles_(grid_of_tiles(zone.grid)) {}

  /// `screened` may be null.
  void survey(const Tin& ground, const Tin* screened, std::span<const std::size_t> tiles) {
    Stopwatch watch;
    progress_.report("scene", 0);
    const TriangleBins bins(ground, tiles_);
    const ZoneSurvey survey(ground, bins, tiles_, zone_);
    zone_.statistics.scene_seconds += watch.lap();
    look(survey, ground, tiles, "sight lines", zone_.bare);
    if (zone_.request.radar) look_from_radar(ground);
    if (screened != nullptr) look(survey, *screened, tiles, "sight lines, screened", *zone_.screened);
  }

 private:
  /// Over one surface at a time, for what is made of it takes memory.
  void look(const ZoneSurvey& survey, const Tin& surface, std::span<const std::size_t> tiles, const std::string& stage,
            Visibility& visibility) {
    Stopwatch watch;
    const BinnedHeights binned(surface);
    const std::vector<VoidShadow> behind_voids = shadows(binned, zone_.request);
    zone_.statistics.scene_seconds += watch.lap();
    zone_.statistics.lines +=
        survey.run({AxisSweep(zone_.request.earth, binned), behind_voids}, tiles, stage, visibility, progress_);
    zone_.statistics.lines_seconds += watch.lap();
    zone_.statistics.retrieval += surface.statistics;
    zone_.statistics.triangles += surface.triangles.size();
  }

  void look_from_radar(const Tin& ground) {
    Stopwatch watch;
    const Observer& radar = *zone_.request.radar;
    const FullSurface surface(ground, nullptr, zone_.request.earth, zone_.grid, tiles_);
    const auto height = surface.height(radar.position);
    Request request;
    request.earth = zone_.request.earth;
    const Eye eye = eye_of(ground.grid, request, radar, height);
    std::optional<VoidShadow> behind_voids;
    if (zone_.request.nodata == NoData::kBlock) behind_voids.emplace(surface.rim(), eye.units);
    const VoidShadow* const shadow = behind_voids ? &*behind_voids : nullptr;
    RadarView& view = zone_.radar.emplace();
    view.ground_m = *height;
    view.height_m = radar_heights(eye, surface, shadow, progress_);
    for (std::size_t k = 0; k < zone_.request.turbines.size(); ++k)
      view.turbine_m.push_back(radar_sees(eye, surface, shadow, zone_.request.turbines[k], zone_.ground_m[k]));
    zone_.statistics.lines_seconds += watch.lap();
  }

  Zone& zone_;
  Progress& progress_;
  RasterGrid tiles_;
};

}  // namespace

Zone survey_turbines(const Tin& ground, const Tin* screened, const ZoneRequest& request, Progress& progress) {
  validate(request);
  Zone zone = lay_out(request, ground.bounds(), [&](Point2 p) { return height_on(ground, p); });
  warn_of_voids(ground, zone);
  if (screened != nullptr) zone.screened = zone.bare;
  std::vector<std::size_t> tiles(grid_of_tiles(zone.grid).cell_count());
  std::iota(tiles.begin(), tiles.end(), std::size_t{0});
  ZoneWork(zone, progress).survey(ground, screened, tiles);
  return zone;
}

Zone survey_turbines(const Store& store, const ZoneRequest& request, Progress& progress) {
  validate(request);
  Stopwatch watch;
  const Tin outline = coverage_of(store, window_of(request), progress);
  Zone zone = lay_out(request, outline.bounds(),
                      [&](Point2 p) { return height_at(store, p, ThemeChoice::none(), progress, request.detail); });
  warn_of_voids(outline, zone);
  const bool stands = request.themes && request.themes->includes_standing(store.metadata().themes);
  if (stands) zone.screened = zone.bare;
  ZoneWork work(zone, progress);
  zone.statistics.retrieval_seconds += watch.lap();
  for (const ZonePart& part : zone_parts(store, zone, stands)) {
    watch.lap();
    const Tin ground = triangulate(store, part.window, request.detail, progress, ThemeChoice::none());
    std::optional<Tin> screened;
    if (stands) screened = triangulate(store, part.window, request.detail, progress, *request.themes);
    zone.statistics.retrieval_seconds += watch.lap();
    work.survey(ground, screened ? &*screened : nullptr, part.tiles);
  }
  if (request.themes && !stands) {
    zone.screened = zone.bare;
    zone.warnings.emplace_back("none of the themes has features that stand on the ground: nothing screens");
  }
  return zone;
}

}  // namespace itin::viewshed
