#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <viewshed/surface.hpp>
#include <viewshed/turbines.hpp>

#include "bounds/boundary.hpp"
#include "line/grid_units.hpp"
#include "progress/stopwatch.hpp"
#include "request/eye.hpp"
#include "request/request.hpp"
#include "request/void_shadow.hpp"
#include "scene/full_surface.hpp"
#include "scene/sweep/radial_sweep.hpp"
#include "turbines/radar_survey.hpp"
#include "turbines/zone_parts.hpp"
#include "turbines/zone_request.hpp"
#include "turbines/zone_survey.hpp"
#include "window/retrieval.hpp"

namespace itin::viewshed {

namespace {

/// What voids hide from each turbine, where they do.
std::vector<VoidShadow> shadows(const FullSurface& surface, const ZoneRequest& request) {
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
    return surface_resumes(tin.grid, rim, t.position, t.radius, hull_about(t.position, disc_box(t.position, t.radius)));
  });
  if (crossed) zone.warnings.emplace_back(kVoidsWarning);
}

/// Surveys the parts of a zone, one after another.
class ZoneWork {
 public:
  ZoneWork(Zone& zone, Progress& progress) : zone_(zone), progress_(progress) {}

  /// `screen` may be null.
  void survey(const FullSurface& ground, const FullSurface* screen, std::span<const std::size_t> tiles) {
    const ZoneSurvey survey(ground, zone_);
    look(survey, ground, tiles, "sight lines", zone_.bare);
    if (zone_.request.radar) look_from_radar(ground);
    if (screen != nullptr) look(survey, *screen, tiles, "sight lines, screened", *zone_.screened);
  }

 private:
  void look(const ZoneSurvey& survey, const FullSurface& surface, std::span<const std::size_t> tiles,
            const std::string& stage, Visibility& visibility) {
    Stopwatch watch;
    const std::vector<VoidShadow> behind_voids = shadows(surface, zone_.request);
    zone_.statistics.lines += survey.run({surface.sweep(), behind_voids}, tiles, stage, visibility, progress_);
    zone_.statistics.lines_seconds += watch.lap();
  }

  void look_from_radar(const FullSurface& surface) {
    Stopwatch watch;
    const Observer& radar = *zone_.request.radar;
    const auto height = surface.height(radar.position);
    Request request;
    request.earth = zone_.request.earth;
    const Eye eye = eye_of(surface.units(), request, radar, height);
    std::optional<VoidShadow> behind_voids;
    if (zone_.request.nodata == NoData::kBlock) behind_voids.emplace(surface.rim(), eye.units);
    const VoidShadow* const shadow = behind_voids ? &*behind_voids : nullptr;
    const RadialSweep::View view = surface.view_from(eye);
    RadarView& seen = zone_.radar.emplace();
    seen.ground_m = *height;
    seen.height_m = radar_heights(view, surface, shadow, progress_);
    for (std::size_t k = 0; k < zone_.request.turbines.size(); ++k)
      seen.turbine_m.push_back(radar_sees(view, surface, shadow, zone_.request.turbines[k], zone_.ground_m[k]));
    zone_.statistics.lines_seconds += watch.lap();
  }

  Zone& zone_;
  Progress& progress_;
};

/// The ground of the whole zone, where that is a lattice and the memory holds it.
std::optional<Surface> lattice_under(const Store& store, const Zone& zone, Progress& progress) {
  std::uint64_t most_posts = kAnyLattice;
  if (const auto memory = zone.request.memory_bytes)
    most_posts = (*memory - std::min(*memory, bytes_of_results(zone))) / kBytesPerPost;
  return retrieve_lattice(store, window_of(zone.request), zone.request.detail, ThemeChoice::none(),
                          LatticeReader::Heights::kAll, most_posts, progress);
}

}  // namespace

Zone survey_turbines(const Tin& ground, const Tin* screened, const ZoneRequest& request, Progress& progress) {
  validate(request);
  Zone zone = lay_out(request, ground.bounds(), [&](Point2 p) { return height_on(ground, p); });
  warn_of_voids(ground, zone);
  const RasterGrid tiles = grid_of_tiles(zone.grid);
  const FullSurface bare(ground, nullptr, request.earth, zone.grid, tiles);
  std::optional<FullSurface> screen;
  if (screened != nullptr) {
    zone.screened = zone.bare;
    screen.emplace(*screened, nullptr, request.earth, zone.grid, tiles);
  }
  ZoneWork(zone, progress).survey(bare, screen ? &*screen : nullptr, whole_zone(zone).tiles);
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
  const RasterGrid tiles = grid_of_tiles(zone.grid);
  ZoneWork work(zone, progress);
  const auto counted = [&](Surface surface) {
    zone.statistics.retrieval_seconds += watch.lap();
    zone.statistics.retrieval += surface.statistics();
    zone.statistics.triangles += surface.triangle_count();
    return surface;
  };
  const auto survey = [&](Surface bare, const ZonePart& part) {
    const OwnedSurface ground(counted(std::move(bare)), std::nullopt, request.earth, zone.grid, tiles);
    std::optional<OwnedSurface> screen;
    if (stands)
      screen.emplace(
          counted(retrieve_surface(store, part.window, request.detail, *request.themes, kAnyLattice, progress)),
          std::nullopt, request.earth, zone.grid, tiles);
    zone.statistics.scene_seconds += watch.lap();
    work.survey(ground.full, screen ? &screen->full : nullptr, part.tiles);
    watch.lap();
  };
  auto lattice = stands ? std::nullopt : lattice_under(store, zone, progress);
  if (lattice) {
    survey(std::move(*lattice), whole_zone(zone));
  } else {
    for (const ZonePart& part : zone_parts(store, zone, stands))
      survey(retrieve_surface(store, part.window, request.detail, ThemeChoice::none(), kAnyLattice, progress), part);
  }
  if (request.themes && !stands) {
    zone.screened = zone.bare;
    zone.warnings.emplace_back("none of the themes has features that stand on the ground: nothing screens");
  }
  return zone;
}

}  // namespace itin::viewshed
