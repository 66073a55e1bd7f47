#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <itin/call_progress.hpp>
#include <itin/silent_progress.hpp>
#include <viewshed/surface.hpp>
#include <viewshed/turbines.hpp>

#include "progress/stage.hpp"
#include "progress/stopwatch.hpp"
#include "scene/full_surface.hpp"
#include "scene/sweep/radial_sweep.hpp"
#include "turbines/open_lines.hpp"
#include "turbines/radar_survey.hpp"
#include "turbines/turbine_shadows.hpp"
#include "turbines/zone_parts.hpp"
#include "turbines/zone_request.hpp"
#include "turbines/zone_survey.hpp"
#include "window/retrieval.hpp"

namespace itin::viewshed {

namespace {

/// Counts the tiles surveyed: each over the ground and, for turbines, also over the surface that screens.
std::size_t steps_of(const std::vector<ZonePart>& parts, bool screened) {
  std::size_t steps = 0;
  for (const ZonePart& part : parts) steps += (screened ? 2 : 1) * part.tiles.size() + part.radar_tiles.size();
  return steps;
}

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
    const FullSurface& surface;
    bool open_alone = false;  ///< whether the surface may cover only the ground beneath open lines (open_lines.hpp)
  };

  /// Surveys a part. There is no screen where the part has no turbines to look for, or nothing screens them.
  void survey(const FullSurface& ground, const std::optional<Screen>& screen, const ZonePart& part, Stage& stage) {
    Stopwatch watch;
    if (!part.tiles.empty()) {
      const ZoneSurvey survey(ground, zone_);
      // Features never reach beyond the ground, and the edges of a window of open lines are no voids.
      const TurbineShadows shadows = shadows_of_turbines(ground, zone_);
      const auto observe = [&](const FullSurface& over, bool open_alone, Visibility& visibility) {
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

/// The share of the time that reading takes, about.
constexpr double kReadingZone = 0.3;

/// Reads the surfaces under the parts of a zone, one after another.
class PartReader {
 public:
  /// Prepares to read. `whole` shows the progress of reading where there is only one part; else it is null.
  PartReader(const Store& store, Zone& zone, CallProgress* whole, Progress& progress)
      : store_(store), zone_(zone), tiles_(grid_of_tiles(zone.grid)), whole_(whole), quiet_(progress) {}

  std::unique_ptr<OwnedSurface> ground(const ZonePart& part) { return read(part.window, ThemeChoice::none()); }

  std::unique_ptr<OwnedSurface> take(Surface surface) {
    Statistics& statistics = zone_.statistics;
    statistics.add_retrieval(surface.statistics(), surface.triangle_count(), watch_.lap());
    auto owned =
        std::make_unique<OwnedSurface>(std::move(surface), std::nullopt, zone_.request.earth, zone_.grid, tiles_);
    statistics.scene_seconds += watch_.lap();
    return owned;
  }

  /// What was read to screen a part.
  struct OwnedScreen {
    std::unique_ptr<OwnedSurface> surface;  ///< null where no features had to be read
    bool open_alone = false;

    /// Returns the screen for the lines over a part; nothing where no features were asked for.
    std::optional<ZoneWork::Screen> over(const FullSurface& ground) const {
      if (surface) return ZoneWork::Screen{surface->full, open_alone};
      return open_alone ? std::optional(ZoneWork::Screen{ground, true}) : std::nullopt;
    }
  };
  /// Reads the surface with features: all of the part, or only where features may rise into lines that are left open.
  /// In the latter case, marks these lines.
  OwnedScreen screen(const ZonePart& part, const FullSurface& ground) {
    const ThemeChoice& themes = *zone_.request.themes;
    if (!may_tell_open_lines(store_, zone_.request)) return {read(part.window, themes), false};
    const std::optional<Window> window = open_lines(part, ground);
    return {window ? read(*window, themes) : nullptr, true};
  }

  void forget_time() { watch_.lap(); }

 private:
  /// Marks the open lines. Returns the ground that they need.
  std::optional<Window> open_lines(const ZonePart& part, const FullSurface& ground) {
    const OpenLines open(store_, zone_, part.window, quiet_);
    zone_.statistics.retrieval += open.retrieval();
    return open.mark(ground, part.tiles, *zone_.screened, quiet_);
  }

  std::unique_ptr<OwnedSurface> read(const Window& window, const ThemeChoice& themes) {
    Progress& reading = whole_ != nullptr ? whole_->step(kReadingZone) : quiet_;
    return take(retrieve_surface(store_, window, zone_.request.detail, themes, kAnyLattice, reading));
  }

  const Store& store_;
  Zone& zone_;
  RasterGrid tiles_;
  CallProgress* whole_;
  SilentProgress quiet_;
  Stopwatch watch_;
};

/// Reads the ground of the whole zone, where it is a lattice and the memory holds it.
std::optional<Surface> lattice_under(const Store& store, const Zone& zone, Progress& progress) {
  std::uint64_t most_posts = kAnyLattice;
  if (const auto memory = zone.request.memory_bytes)
    most_posts = (*memory - std::min(*memory, bytes_beside_surfaces(zone))) / kBytesPerPost;
  return retrieve_lattice(store, window_of(zone.request), zone.request.detail, ThemeChoice::none(),
                          LatticeReader::Heights::kAll, most_posts, progress);
}

}  // namespace

Zone survey_turbines(const Tin& ground, const Tin* screened, const ZoneRequest& request, Progress& progress) {
  validate(request);
  const auto height = [&](Point2 p) { return height_on(ground, p); };
  Zone zone = lay_out(request, ground, height, screened != nullptr);
  ZoneWork work(ground.grid, height, zone);
  const RasterGrid tiles = grid_of_tiles(zone.grid);
  const FullSurface bare(ground, nullptr, request.earth, zone.grid, tiles);
  std::optional<FullSurface> screen;
  if (screened != nullptr) screen.emplace(*screened, nullptr, request.earth, zone.grid, tiles);
  const ZonePart whole = whole_zone(zone);
  Stage stage("sight lines", steps_of({whole}, screen.has_value()), progress);
  work.survey(bare, screen ? std::optional(ZoneWork::Screen{*screen}) : std::nullopt, whole, stage);
  return zone;
}

Zone survey_turbines(const Store& store, const ZoneRequest& request, Progress& progress) {
  validate(request);
  const auto height = [&](Point2 p) { return height_at(store, p, ThemeChoice::none(), progress, request.detail); };
  const Tin outline = coverage_of(store, window_of(request), progress);
  const bool screens = request.themes && request.themes->includes_raised(store.metadata().themes);
  Zone zone = lay_out(request, outline, height, screens);
  ZoneWork work(store.metadata().grid, height, zone);

  CallProgress call(progress);
  auto lattice = screens ? std::nullopt : lattice_under(store, zone, call.step(kReadingZone));
  const std::vector<ZonePart> parts = lattice ? std::vector{whole_zone(zone)} : zone_parts(store, zone, screens);
  PartReader reader(store, zone, parts.size() == 1 ? &call : nullptr, progress);
  std::optional<Stage> stage;
  for (const ZonePart& part : parts) {
    const auto ground = lattice ? reader.take(std::move(*lattice)) : reader.ground(part);
    const auto screen = screens && !part.tiles.empty() ? reader.screen(part, ground->full) : PartReader::OwnedScreen{};
    if (!stage) stage.emplace("sight lines", steps_of(parts, screens), call.step(1));
    work.survey(ground->full, screen.over(ground->full), part, *stage);
    reader.forget_time();
  }
  if (request.themes && !screens) {
    zone.screened = zone.bare;
    zone.warnings.emplace_back("none of the themes has features that stand on the ground: nothing screens");
  }
  call.finish();
  return zone;
}

}  // namespace itin::viewshed
