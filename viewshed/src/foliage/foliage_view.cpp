#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include <itin/call_progress.hpp>
#include <itin/error.hpp>
#include <itin/level_choice.hpp>
#include <itin/silent_progress.hpp>
#include <itin/triangulate.hpp>
#include <profile/foliage.hpp>
#include <viewshed/foliage_view.hpp>
#include <viewshed/surface.hpp>

#include "exact/compute.hpp"
#include "foliage/foliage_lines.hpp"
#include "foliage/raised_centres.hpp"
#include "line/cell_tiles.hpp"
#include "line/verdicts.hpp"
#include "plan/azimuth_order.hpp"
#include "plan/ground_runs.hpp"
#include "plan/ground_tiles.hpp"
#include "plan/memory.hpp"
#include "progress/stopwatch.hpp"
#include "request/request_window.hpp"
#include "scene/exact_scene.hpp"

namespace itin::viewshed {

namespace {

constexpr float kUntold = std::numeric_limits<float>::quiet_NaN();

/// The parts of the time that the viewsheds with and without woods, and the lines between the two take, about.
constexpr double kFullShare = 0.4, kSolidShare = 0.4;

/// What one observer sees, by cell.
struct SeenThrough {
  std::vector<Verdict> solid;       ///< without foliage
  std::vector<LightThrough> light;  ///< through it; not numbers where FoliageView has none
};

/// The cells of one tile that are between the two viewsheds.
struct CellsBetween {
  std::size_t tile = 0;
  std::vector<std::uint32_t> cells;  ///< in the grid
};

/// Both viewsheds, and what light comes through from one observer after another.
class FoliageSurvey {
 public:
  /// `lines` run over the surface with the woods. Store, viewshed and lines must outlive the survey.
  FoliageSurvey(const Store& store, const ViewshedWithSurface& full, const FoliageLines& lines,
                const ComputeOptions& options, Progress& progress)
      : store_(store),
        full_(full),
        options_(options),
        lines_(lines),
        grid_(full.result.grid),
        tiles_(grid_of_tiles(grid_)) {
    Request request = full.result.request;
    request.cell_size.reset();
    request.grid = grid_;
    request.themes = request.themes.without_vegetation();
    solid_ = compute_with_surface(store, request, options, progress);
    statistics_ = solid_.result.statistics;
    if (solid_.whole) find_grounds();
    if (!full.whole)
      tiles_of_ground_.emplace(store, level_within(store.metadata(), request.detail.finest()),
                               box_of_window(store, request));
  }

  /// The work that was done beside the viewshed with the woods.
  const Statistics& statistics() const { return statistics_; }

  /// Computes what an observer's lines come to.
  SeenThrough from_observer(std::size_t i, Progress& progress) {
    CallProgress call(progress);
    const Result full = of_observer(full_, i, call.step(0.3)), solid = of_observer(solid_, i, call.step(0.4));
    Stopwatch watch;
    const std::vector<CellsBetween> between = cells_between(full, solid);
    SeenThrough seen{solid.visible, without_foliage(solid.visible)};
    const Observer& observer = solid.request.observers.front();
    const Point3 eye{observer.position.x, observer.position.y,
                     observer.absolute ? observer.height : solid.ground_m.front() + observer.height};
    for_each_surface(observer.position, between, call, [&](const Tin& surface, std::span<const CellsBetween> some) {
      walk(surface, eye, some, solid.request, call, seen.light);
    });
    statistics_.lines_seconds += watch.lap();
    call.finish();
    return seen;
  }

 private:
  Result of_observer(const ViewshedWithSurface& all, std::size_t i, Progress& progress) const {
    if (all.result.request.observers.size() == 1) return all.result;
    const Request request = request_for_observer(all.result, i);
    return all.whole ? compute_on_surface(store_, all, request, progress)
                     : compute_result(store_, request, options_, progress);
  }

  /// Lists the cells that nothing solid hides, but woods may, by tiles.
  std::vector<CellsBetween> cells_between(const Result& full, const Result& solid) const {
    // Where ends stand on the surface, woods raise them in the one viewshed alone.
    const bool bounded = !solid.request.observers_on_surface && !solid.request.targets_on_surface;
    std::vector<CellsBetween> between;
    for (std::size_t i = 0; i < tiles_.cell_count(); ++i) {
      CellsBetween some{i, {}};
      for_each_cell(tile_at(grid_, tiles_, i), [&](std::size_t, RasterGrid::Cell place) {
        const std::size_t cell = grid_.index(place);
        const Verdict verdict = solid.visible[cell];
        if (verdict != Verdict::kVisible && verdict != Verdict::kUndecided) return;
        if (!bounded || full.visible[cell] == Verdict::kHidden) some.cells.push_back(static_cast<std::uint32_t>(cell));
      });
      if (!some.cells.empty()) between.push_back(std::move(some));
    }
    return between;
  }

  static std::vector<LightThrough> without_foliage(const std::vector<Verdict>& solid) {
    std::vector<LightThrough> light(solid.size(), {NAN, NAN});
    for (std::size_t cell = 0; cell < solid.size(); ++cell) {
      if (solid[cell] == Verdict::kHidden) light[cell].transmittance = 0;
      if (solid[cell] == Verdict::kVisible || solid[cell] == Verdict::kUndecided) light[cell] = {0, 1};
    }
    return light;
  }

  /// Calls visit(surface, cells) for surfaces with the woods under the lines to some cells: the one that was read, or
  /// as much as the memory holds for cells next to each other in azimuth.
  template <class Visit>
  void for_each_surface(Point2 eye, std::span<const CellsBetween> between, Progress& progress, const Visit& visit) {
    if (between.empty()) return;
    if (full_.whole) {
      visit(full_.surface->listed(progress), between);
      return;
    }
    const Request& request = full_.result.request;
    const GroundTiles& ground = *tiles_of_ground_;
    std::vector<TileSet> needed;
    std::vector<std::size_t> order;
    for (const CellsBetween& some : between) {
      order.push_back(order.size());
      ground.add_lines(eye, box_of_centres(grid_, tile_at(grid_, tiles_, some.tile)),
                       needed.emplace_back(ground.count()));
    }
    const auto centre = [&](std::size_t i) {
      return middle_of(box_of_centres(grid_, tile_at(grid_, tiles_, between[i].tile)));
    };
    sort_by_azimuth(eye, centre, order);
    const std::uint64_t most =
        memory_beside_rasters(options_.memory_bytes, store_, request) / (kBytesPerSurfacePoint * kPointsWithFeatures);
    const auto runs = ground_runs(
        order, ground.count(), [&](std::size_t i) -> const TileSet& { return needed[i]; },
        [&](const TileSet& tiles) { return ground.points(tiles) <= most; });
    for (const GroundRun& run : runs) {
      SilentProgress reading(progress);
      const Tin surface = triangulate(store_, ground.window(run.ground), request.detail, reading, request.themes);
      std::vector<CellsBetween> some;
      for (const std::size_t i : run.pieces) some.push_back(between[i]);
      visit(surface, some);
    }
  }

  /// Enters the light that comes from cells.
  void walk(const Tin& surface, const Point3& eye, std::span<const CellsBetween> between, const Request& request,
            Progress& progress, std::vector<LightThrough>& light) {
    std::vector<std::size_t> cells;
    for (const CellsBetween& some : between) cells.insert(cells.end(), some.cells.begin(), some.cells.end());
    const std::vector<Point3> targets =
        raised_centres(grid_, cells, grounds_of(between, cells, request, progress),
                       request.observers.front().target_height.value_or(request.target_height));
    const std::vector<LightThrough> found = lines_.between(surface, eye, targets, progress);
    statistics_.lines += cells.size();
    for (std::size_t i = 0; i < cells.size(); ++i) light[cells[i]] = found[i];
  }

  /// Returns what the heights of targets count from. `cells` are all those of `between`.
  std::vector<double> grounds_of(std::span<const CellsBetween> between, std::span<const std::size_t> cells,
                                 const Request& request, Progress& progress) const {
    if (request.target_absolute) return std::vector<double>(cells.size(), 0);
    if (grounds_) return grounds_in_memory(between);
    return heights_at_centres(store_, grid_, cells, request.detail,
                              request.targets_on_surface ? request.themes : ThemeChoice::none(), progress);
  }

  std::vector<double> grounds_in_memory(std::span<const CellsBetween> between) const {
    std::vector<double> grounds;
    for (const CellsBetween& some : between) {
      const auto work = grounds_->begin(some.tile);
      const Tile tile = tile_at(grid_, tiles_, some.tile);
      for (const std::uint32_t cell : some.cells)
        grounds.push_back(work->ground[tile.cell(place_of(grid_, cell))] * grounds_->units().resolution);
    }
    return grounds;
  }

  /// Prepares the heights of what targets stand on.
  void find_grounds() {
    const Request& request = solid_.result.request;
    if (solid_.ground && !request.targets_on_surface) {
      grounds_ = std::make_unique<ExactScene>(*solid_.ground, nullptr, request.earth, grid_, tiles_);
    } else if (solid_.surface->lattice) {
      grounds_ = std::make_unique<ExactScene>(solid_.surface->lattice->lattice(), request.earth, grid_, tiles_);
    } else {
      grounds_ = std::make_unique<ExactScene>(solid_.surface->tin, nullptr, request.earth, grid_, tiles_);
    }
  }

  const Store& store_;
  const ViewshedWithSurface& full_;
  ComputeOptions options_;
  const FoliageLines& lines_;
  RasterGrid grid_, tiles_;
  ViewshedWithSurface solid_;
  Statistics statistics_;
  std::optional<GroundTiles> tiles_of_ground_;  ///< none where the surface with the woods was read as a whole
  std::unique_ptr<const ExactScene> grounds_;   ///< none where the surface was not read as a whole
};

/// Whether light comes through better than before.
bool is_better(double transmittance, double before) {
  return !std::isnan(transmittance) && (std::isnan(before) || transmittance > before);
}

Verdict verdict_of(double transmittance, Verdict solid, double least) {
  return solid != Verdict::kOutside && transmittance < least ? Verdict::kHidden : solid;
}

void count_again(Result& result) {
  const auto count = [&](Verdict verdict) {
    return static_cast<std::uint64_t>(std::count(result.visible.begin(), result.visible.end(), verdict));
  };
  result.cells = {count(Verdict::kVisible), count(Verdict::kHidden), count(Verdict::kUndecided),
                  count(Verdict::kOutside)};
}

}  // namespace

ThroughFoliage compute_through_foliage(const Store& store, const Request& request, const profile::Foliage& foliage,
                                       const ComputeOptions& options, Progress& progress) {
  if (request.mode != Mode::kVisible) throw InputError("`foliage`: only mode visible sees through woods", "foliage");
  const FoliageLines lines(store, {request.detail, request.themes, request.earth}, foliage);
  CallProgress call(progress);
  // Both surfaces are in memory together, and lines are walked over all of the one with the woods.
  ComputeOptions half = options;
  half.memory_bytes /= 2;
  half.whole_surface = true;
  half.sink = {};
  ThroughFoliage through{compute_with_surface(store, request, half, call.step(kFullShare)), {}};
  Result& result = through.computed.result;
  FoliageSurvey survey(store, through.computed, lines, half, call.step(kSolidShare / (1 - kFullShare)));
  const std::size_t cells = result.visible.size(), observers = result.request.observers.size();
  FoliageView& view = through.foliage;
  view = {std::vector<float>(cells, kUntold), std::vector<float>(cells, kUntold)};
  std::vector<Verdict> verdicts(cells, Verdict::kOutside);
  for (std::size_t i = 0; i < observers; ++i) {
    const SeenThrough seen = survey.from_observer(i, call.step(1.0 / static_cast<double>(observers - i)));
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const LightThrough& light = seen.light[cell];
      if (is_better(light.transmittance, view.transmittance[cell])) {
        view.transmittance[cell] = static_cast<float>(light.transmittance);
        view.length_m[cell] = static_cast<float>(light.length_m);
      }
      verdicts[cell] =
          better_of(verdicts[cell], verdict_of(light.transmittance, seen.solid[cell], foliage.least_transmittance));
    }
  }
  result.visible = std::move(verdicts);
  result.statistics += survey.statistics();
  count_again(result);
  call.finish();
  return through;
}

}  // namespace itin::viewshed
