#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <itin/call_progress.hpp>
#include <viewshed/surface.hpp>
#include <viewshed/turbines.hpp>

#include "plan/effort.hpp"
#include "progress/stage.hpp"
#include "progress/stopwatch.hpp"
#include "run/segments.hpp"
#include "run/surface_reader.hpp"
#include "scene/exact_scene.hpp"
#include "scene/sweep/radial_sweep.hpp"
#include "turbines/open_lines.hpp"
#include "turbines/radar_survey.hpp"
#include "turbines/turbine_shadows.hpp"
#include "turbines/zone_parts.hpp"
#include "turbines/zone_request.hpp"
#include "turbines/zone_seasons.hpp"
#include "turbines/zone_survey.hpp"
#include "window/retrieval.hpp"

namespace itin::viewshed {

namespace {

/// Surveys the parts of a zone, one after another.
class ZoneWork {
 public:
  /// Prepares the surveys; `ground` gives the elevation under the radar, metres. Throws InputError where there is no
  /// ground.
  template <class Ground>
  ZoneWork(const Grid& units, const Ground& ground, Zone& zone) : zone_(zone) {
    if (const auto& radar = zone.request.radar) radar_.emplace(units, ground(radar->position), zone);
  }

  /// The surface with features, which screens.
  struct Screen {
    const ExactScene& surface;
    bool open_alone = false;  ///< whether the surface may cover only the ground beneath open lines (open_lines.hpp)
  };

  /// Surveys a part. There is no screen where the part has no turbines to look for, or nothing screens them.
  void survey(const ExactScene& ground, const std::optional<Screen>& screen, const ZonePart& part, Progress& progress) {
    Stopwatch watch;
    Stage stage("sight lines", (screen ? 2 : 1) * part.tiles.size() + part.radar_tiles.size(), progress);
    if (!part.tiles.empty()) {
      const ZoneSurvey survey(ground, zone_);
      // Features never reach beyond the ground, and the edges of a window of open lines are no voids.
      const TurbineShadows shadows = shadows_of_turbines(ground, zone_);
      const auto observe = [&](const ExactScene& over, bool open_alone, Visibility& visibility) {
        zone_.statistics.lines += survey.run({over.sweep(), shadows, open_alone}, part.tiles, visibility, stage);
      };
      observe(ground, false, zone_.bare);
      if (screen) observe(screen->surface, screen->open_alone, *zone_.screened);
    }
    if (radar_) radar_->run(ground, part, stage);
    zone_.statistics.lines_seconds += watch.lap();
  }

 private:
  Zone& zone_;
  std::optional<RadarSurvey> radar_;
};

/// Reads the surfaces under the parts of a zone, one after another.
class PartReader {
 public:
  PartReader(const Store& store, Zone& zone)
      : store_(store),
        zone_(zone),
        tiles_(grid_of_tiles(zone.grid)),
        reader_(store, zone.request.detail, zone.statistics) {}

  /// Reads the ground of the whole zone, where it is a lattice and the memory holds it.
  std::unique_ptr<OwnedScene> lattice(Progress& progress) {
    std::uint64_t most_posts = kAnyLattice;
    if (const auto memory = zone_.request.memory_bytes)
      most_posts = (*memory - std::min(*memory, bytes_beside_surfaces(zone_))) / kBytesPerPost;
    auto lattice = reader_.lattice(window_of(zone_.request), ThemeChoice::none(), most_posts, progress);
    return lattice ? owned(std::move(*lattice)) : nullptr;
  }

  std::unique_ptr<OwnedScene> ground(const ZonePart& part, Progress& progress) {
    return read(part.window, ThemeChoice::none(), progress);
  }

  /// What was read to screen a part.
  struct OwnedScreen {
    std::unique_ptr<OwnedScene> surface;  ///< null where no features had to be read
    bool open_alone = false;

    /// Returns the screen for the lines over a part; nothing where no features were asked for.
    std::optional<ZoneWork::Screen> over(const ExactScene& ground) const {
      if (surface) return ZoneWork::Screen{surface->full, open_alone};
      return open_alone ? std::optional(ZoneWork::Screen{ground, true}) : std::nullopt;
    }
  };
  /// Reads the surface with features: all of the part, or only where features may rise into lines that are left open.
  /// In the latter case, marks these lines.
  OwnedScreen screen(const ZonePart& part, const ExactScene& ground, Progress& progress) {
    const ThemeChoice& themes = *zone_.request.themes;
    if (!may_tell_open_lines(store_, zone_.request)) return {read(part.window, themes, progress), false};
    CallProgress call(progress);
    const std::optional<Window> window = open_lines(part, ground, call);
    return {window ? read(*window, themes, call.step(1)) : nullptr, true};
  }

 private:
  /// Marks the open lines. Returns the ground that they need.
  std::optional<Window> open_lines(const ZonePart& part, const ExactScene& ground, CallProgress& call) {
    const OpenLines open(store_, zone_, part.window, call.step(kEnclosing));
    zone_.statistics.retrieval += open.retrieval();
    return open.mark(ground, part.tiles, *zone_.screened, call.step(kMarking));
  }

  std::unique_ptr<OwnedScene> read(const Window& window, const ThemeChoice& themes, Progress& progress) {
    return owned(reader_.surface(window, themes, kAnyLattice, progress));
  }

  std::unique_ptr<OwnedScene> owned(RetrievedSurface surface) {
    Stopwatch watch;
    auto owned =
        std::make_unique<OwnedScene>(std::move(surface), std::nullopt, zone_.request.earth, zone_.grid, tiles_);
    zone_.statistics.scene_seconds += watch.lap();
    return owned;
  }

  /// About the shares of the time left, of reading what screens.
  static constexpr double kEnclosing = 0.4, kMarking = 0.3;

  const Store& store_;
  Zone& zone_;
  RasterGrid tiles_;
  SurfaceReader reader_;
};

/// About how long a part takes. Half of the lines are open to turbines, on average.
Effort effort_of(const Zone& zone, const ZonePart& part, bool screens) {
  const double cells =
      static_cast<double>(zone.grid.cell_count()) / static_cast<double>(grid_of_tiles(zone.grid).cell_count());
  const double lines = cells * (static_cast<double>(part.tiles.size() * zone.request.turbines.size()) / 2 +
                                static_cast<double>(part.radar_tiles.size()));
  return {(screens && !part.tiles.empty() ? 2 : 1) * effort_of_triangles(part.points),
          (screens ? 2 : 1) * effort_of_swept_lines(lines)};
}

/// About the share of the time that it takes to read a lattice.
constexpr double kReadingLattice = 0.05;

/// About the share of the time that a survey of solid woods takes, where they are also seen through.
constexpr double kSolidShare = 0.3;

}  // namespace

Zone survey_turbines(const Tin& ground, const Tin* screened, const ZoneRequest& request, Progress& progress) {
  validate(request);
  const auto height = [&](Point2 p) { return height_on(ground, p); };
  Zone zone = placed_zone(request, ground, height, screened != nullptr);
  make_room(zone);
  ZoneWork work(ground.grid, height, zone);
  const RasterGrid tiles = grid_of_tiles(zone.grid);
  const ExactScene bare(ground, nullptr, request.earth, zone.grid, tiles);
  std::optional<ExactScene> screen;
  if (screened != nullptr) screen.emplace(*screened, nullptr, request.earth, zone.grid, tiles);
  const ZonePart whole = whole_zone(zone);
  work.survey(bare, screen ? std::optional(ZoneWork::Screen{*screen}) : std::nullopt, whole, progress);
  return zone;
}

namespace {

/// Surveys turbines on a surface whose woods are solid.
Zone survey_solid(const Store& store, const ZoneRequest& request, Progress& progress) {
  Zone zone = placed_zone(store, request, progress);
  make_room(zone);
  const bool screens = zone.screened.has_value();
  const auto height = [&](Point2 p) { return height_at(store, p, ThemeChoice::none(), progress, request.detail); };
  ZoneWork work(store.metadata().grid, height, zone);

  PartReader reader(store, zone);
  const auto effort = [&](const ZonePart& part) { return effort_of(zone, part, screens); };
  const auto survey = [&](const ZonePart& part, SegmentProgress& of_part) {
    const double ground_alone = screens && !part.tiles.empty() ? 0.5 : 1;
    const auto ground = reader.ground(part, of_part.reading(ground_alone));
    const auto screen =
        ground_alone < 1 ? reader.screen(part, ground->full, of_part.reading()) : PartReader::OwnedScreen{};
    work.survey(ground->full, screen.over(ground->full), part, of_part.judging());
  };
  CallProgress call(progress);
  const auto lattice = screens ? nullptr : reader.lattice(call.step(kReadingLattice));
  if (lattice)
    work.survey(lattice->full, std::nullopt, whole_zone(zone), call.step(1));
  else
    for_each_segment(zone_parts(store, zone, screens), effort, call.step(1), survey);
  complete_screen(zone);
  call.finish();
  return zone;
}

}  // namespace

Zone placed_zone(const Store& store, const ZoneRequest& request, Progress& progress) {
  validate(request);
  const Tin outline = coverage_of(store, window_of(request), progress);
  return placed_zone(
      request, outline, [&](Point2 p) { return height_at(store, p, ThemeChoice::none(), progress, request.detail); },
      request.themes && request.themes->includes_raised(store.metadata().themes));
}

void complete_screen(Zone& zone) {
  if (!zone.request.themes || zone.screened) return;
  zone.screened = zone.bare;
  zone.warnings.emplace_back("none of the themes has features that stand on the ground: nothing screens");
}

Zone survey_turbines(const Store& store, const ZoneRequest& request, Progress& progress) {
  if (!request.foliage) return survey_solid(store, request, progress);
  CallProgress call(progress);
  Zone zone = survey_solid(store, request, call.step(kSolidShare));
  const auto survey = [&](const ZoneRequest& asked, Progress& step) { return survey_solid(store, asked, step); };
  zone.seasons = survey_seasons(store, zone, survey, call.step(1));
  call.finish();
  return zone;
}

}  // namespace itin::viewshed
