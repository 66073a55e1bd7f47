#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include <itin/error.hpp>
#include <itin/parallel.hpp>
#include <viewshed/certified.hpp>

#include "certified_pass.hpp"
#include "ground_tiles.hpp"
#include "near_ground.hpp"
#include "observation.hpp"
#include "request.hpp"
#include "stopwatch.hpp"

namespace itin::viewshed {

namespace {

/// Peak memory a point of an envelope: triangulation, two surfaces, two scenes.
constexpr std::uint64_t kBytesAPoint = 1200;
/// No coarse pass over so few points: the full surface is as fast.
constexpr std::uint64_t kFewPoints = 40000;
/// The coarse pass reads so much less than the full surface.
constexpr std::uint64_t kCoarseShare = 12;

bool decided(std::uint8_t value) {
  return value != kUndecided;
}

/// One observer's raster on its way.
class Refinement {
 public:
  Refinement(const RasterGrid& grid, const RasterGrid& tiles, Progress& progress)
      : grid_(grid), tiles_(tiles), progress_(progress), values_(grid.cell_count(), kUndecided) {}

  std::vector<std::uint8_t>& values() { return values_; }
  std::uint64_t rays() const { return rays_; }

  /// Judges the tiles of cells by a scene. `doubtful(tile, work, values, lines)` gets what stays undecided.
  template <class OnDoubtful>
  void judge(const EnvelopeScene& scene, const Eye& eye, const std::vector<std::size_t>& cells,
             const OnDoubtful& doubtful) {
    const CertifiedPass pass(scene, grid_, tiles_);
    const EnvelopeScene::Look look = scene.look_from(eye);
    parallel_for(cells.size(), [&](std::size_t i) {
      progress_.throw_if_cancelled();
      const auto work = pass.begin(cells[i]);
      TileValues<std::uint8_t> values;
      values.fill(kOutside);
      for_each_row(work->tile, [&](std::size_t in_tile, std::size_t in_grid, std::size_t n) {
        std::copy_n(values_.data() + in_grid, n, values.data() + in_tile);
      });
      pass.judge(look, values, *work, [&](const Doubtful& d) { doubtful(i, *work, values, d); });
      for_each_row(work->tile, [&](std::size_t in_tile, std::size_t in_grid, std::size_t n) {
        std::copy_n(values.data() + in_tile, n, values_.data() + in_grid);
      });
      rays_ += work->rays;
      report(work->tile);
    });
  }

 private:
  template <class Visit>
  void for_each_row(const Tile& tile, const Visit& visit) const {
    for (std::int64_t r = 0; r < tile.rows; ++r)
      visit(static_cast<std::size_t>(r * Tile::kSide), grid_.index({tile.column, tile.row + r}),
            static_cast<std::size_t>(tile.columns));
  }

  void report(const Tile& tile) {
    std::uint64_t now = 0;
    for_each_row(tile, [&](std::size_t, std::size_t in_grid, std::size_t n) {
      now += static_cast<std::uint64_t>(std::count_if(values_.data() + in_grid, values_.data() + in_grid + n, decided));
    });
    const std::lock_guard lock(mutex_);
    std::uint64_t& before = decided_[grid_.index({tile.column, tile.row})];
    done_ += now - before;
    before = now;
    progress_.report("cells decided", static_cast<double>(done_) / static_cast<double>(values_.size()));
  }

  const RasterGrid& grid_;
  const RasterGrid& tiles_;
  Progress& progress_;
  std::vector<std::uint8_t> values_;
  std::atomic<std::uint64_t> rays_ = 0;
  std::mutex mutex_;
  std::map<std::size_t, std::uint64_t> decided_;
  std::uint64_t done_ = 0;
};

Point2 along(const Grid& grid, const SightLines& lines, unsigned i, double s) {
  return {grid.origin.x + (lines.from_x[i] + s * (lines.to_x[i] - lines.from_x[i])) * grid.resolution,
          grid.origin.y + (lines.from_y[i] + s * (lines.to_y[i] - lines.from_y[i])) * grid.resolution};
}

std::size_t cell_of(const Doubtful& d, unsigned i) {
  return (d.row + i / kPacketSide) * Tile::kSide + d.column + i % kPacketSide;
}

template <class Visit>
void for_each_line(unsigned active, const Visit& visit) {
  for (; active != 0; active &= active - 1) visit(static_cast<unsigned>(std::countr_zero(active)));
}

/// The exact answer for lines over the full surface, which only has to be there where the upper surface comes near.
void walk(const EnvelopeScene& scene, const Doubtful& d, TileValues<std::uint8_t>& values) {
  UpperScene::Stretches stretches;
  scene.upper.find_stretches(d.lines, d.starts_under, d.ends_under, stretches);
  for_each_line(d.lines.active, [&](unsigned i) {
    const bool hidden = std::any_of(stretches[i].begin(), stretches[i].end(), [&](const Stretch& s) {
      return scene.lower.hidden_between(d.lines, i, s.from, s.to);
    });
    values[cell_of(d, i)] = hidden ? kCertainlyHidden : kCertainlyVisible;
  });
}

Voids voids_of(NoData rule) {
  return rule == NoData::kBlock ? Voids::kBlock : Voids::kPass;
}

class Precise {
 public:
  Precise(const Store& store, const Request& request, const PreciseOptions& options, Progress& progress)
      : store_(store),
        request_(request),
        features_(features_stand(store, request)),
        budget_(options.memory_bytes / 2 / kBytesAPoint),
        progress_(progress) {}

  Surveyed run() {
    validate(request_);
    require_mode();
    Result& result = surveyed_.result;
    result.request = request_;
    Stopwatch watch;
    const std::vector<Eye> eyes = eyes_on_full_surface(store_, request_, result.ground_m, progress_);
    const int level = first_level();
    Envelope envelope = envelop(store_, certified_request(store_, request_, level), progress_);
    result.grid = cells_of(request_, envelope.lower.bounds());
    tiles_ = grid_of_tiles(result.grid);
    surveyed_.tin = envelope.lower;
    count(envelope);
    look_for_voids(envelope);
    ground_.emplace(store_, envelope.lower.bounds());
    result.statistics.retrieval_seconds = watch.lap();
    if (level == 0 || !features_) {
      first_.emplace(std::move(envelope), request_, tiles_, voids_of(request_.nodata));
    } else if (result.crosses_voids && request_.nodata == NoData::kBlock) {
      throw InputError(
          "with --themes, --nodata block needs the whole window in memory: give more --memory or a smaller --radius");
    }
    result.statistics.scene_seconds = watch.lap();
    for (std::size_t tile = 0; tile < tiles_.cell_count(); ++tile)
      observations_.push_back(Observations(request_).of_tile());
    for (std::uint32_t i = 0; i < eyes.size(); ++i) look(eyes[i], i);
    finish();
    result.statistics.rays_seconds = watch.lap();
    return std::move(surveyed_);
  }

 private:
  /// Cells that a coarse level decides have no exact height of ground.
  void require_mode() const {
    using enum Mode;
    for (const Mode mode : {kVisible, kCount, kWhich, kNearest})
      if (request_.mode == mode) return;
    throw InputError("precise viewsheds tell visible, count, which and nearest; choose one of these modes");
  }

  int first_level() const {
    const Window window = window_of(request_);
    const Box box = window.is_all() ? store_.metadata().grid.box(store_.metadata().bounds) : window.bounds();
    const std::uint64_t all = store_.points_about(0, box);
    if (all <= (features_ ? budget_ : std::min(budget_, kFewPoints))) return 0;
    int level = 1;
    while (level + 1 < static_cast<int>(store_.metadata().levels.size()) &&
           store_.points_about(level, box) > std::min(budget_, all / kCoarseShare))
      ++level;
    return level;
  }

  void count(const Envelope& envelope) {
    Statistics& statistics = surveyed_.result.statistics;
    statistics.retrieval += envelope.lower.statistics;
    statistics.triangles += envelope.lower.triangles.size();
  }

  void look_for_voids(const Envelope& envelope) {
    Result& result = surveyed_.result;
    for (const Observer& observer : request_.observers) {
      const double reach = radius_of(request_, observer).value_or(std::numeric_limits<double>::infinity());
      result.crosses_voids =
          result.crosses_voids || surface_resumes(envelope.lower, envelope.outline, observer.position, reach);
    }
    if (result.crosses_voids && request_.nodata == NoData::kUnknown) result.warnings.emplace_back(kVoidsWarning);
  }

  void look(const Eye& eye, std::uint32_t observer) {
    Refinement refinement(surveyed_.result.grid, tiles_, progress_);
    for_each_look(eye, observer, [&](const Observation& observation, const Look& look, std::size_t place) {
      if (!observation.open(look)) refinement.values()[place] = kOutside;
    });
    std::vector<std::size_t> all(tiles_.cell_count());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    if (first_ && first_->exact) {
      refinement.judge(*first_, eye, all,
                       [&](std::size_t, const auto&, auto& values, const Doubtful& d) { walk(*first_, d, values); });
    } else {
      // Certificates know nothing of what stands on the ground: then whole lines are needed.
      const std::vector<TileSet> needed = features_ ? under_lines(eye, refinement) : coarse_pass(eye, all, refinement);
      // The scene's memory is free for the segments, when no other observer needs it.
      if (observer + 1 == request_.observers.size()) first_.reset();
      for (const std::vector<std::size_t>& segment : segments(eye, needed)) refine(eye, segment, needed, refinement);
    }
    surveyed_.result.statistics.rays += refinement.rays();
    for_each_look(eye, observer, [&](Observation& observation, const Look& look, std::size_t place) {
      const std::uint8_t value = refinement.values()[place];
      if (value != kOutside) observation.enter(look.cell);
      if (value == kCertainlyVisible) observation.see(look);
    });
  }

  /// Calls visit(observation, look, place in the grid) for every cell; the looks know no heights.
  template <class Visit>
  void for_each_look(const Eye& eye, std::uint32_t observer, const Visit& visit) const {
    const RasterGrid& grid = surveyed_.result.grid;
    parallel_for(observations_.size(), [&](std::size_t i) {
      const Tile tile = tile_at(grid, tiles_, i);
      for (std::int64_t r = 0; r < tile.rows; ++r) {
        for (std::int64_t c = 0; c < tile.columns; ++c) {
          const Point2 centre = grid.centre(tile.column + c, tile.row + r);
          visit(*observations_[i],
                {static_cast<std::size_t>(r * Tile::kSide + c), observer, centre.x - eye.position.x,
                 centre.y - eye.position.y, 0},
                grid.index({tile.column + c, tile.row + r}));
        }
      }
    });
  }

  /// The ground that each tile's undecided lines need at full detail.
  std::vector<TileSet> coarse_pass(const Eye& eye, const std::vector<std::size_t>& all, Refinement& refinement) {
    std::vector<TileSet> needed(all.size());
    const Grid& units = store_.metadata().grid;
    refinement.judge(*first_, eye, all, [&](std::size_t tile, const auto&, const auto&, const Doubtful& d) {
      if (needed[tile].empty()) needed[tile] = TileSet(ground_->count());
      UpperScene::Stretches stretches;
      first_->upper.find_stretches(d.lines, d.starts_under, d.ends_under, stretches);
      for_each_line(d.lines.active, [&](unsigned i) {
        const Point2 target = along(units, d.lines, i, 1);
        ground_->add_line(target, target, needed[tile]);
        for (const Stretch& s : stretches[i])
          ground_->add_line(along(units, d.lines, i, s.from), along(units, d.lines, i, s.to), needed[tile]);
      });
    });
    return needed;
  }

  /// The ground under all lines in view to each tile's cells. Cells out of view become kOutside.
  std::vector<TileSet> under_lines(const Eye& eye, Refinement& refinement) {
    const RasterGrid& grid = surveyed_.result.grid;
    constexpr double kAnyHeight = 1e9;
    std::vector<TileSet> needed(tiles_.cell_count());
    parallel_for(needed.size(), [&](std::size_t i) {
      const Tile tile = tile_at(grid, tiles_, i);
      for (std::int64_t r = 0; r < tile.rows; ++r) {
        for (std::int64_t c = 0; c < tile.columns; ++c) {
          std::uint8_t& value = refinement.values()[grid.index({tile.column + c, tile.row + r})];
          if (value != kUndecided) continue;
          const Point2 centre = grid.centre(tile.column + c, tile.row + r);
          if (eye.view.contains(centre.x - eye.position.x, centre.y - eye.position.y, -kAnyHeight, kAnyHeight) ==
              false) {
            value = kOutside;
            continue;
          }
          if (needed[i].empty()) needed[i] = TileSet(ground_->count());
          ground_->add_line(eye.position, centre, needed[i]);
        }
      }
    });
    return needed;
  }

  /// Tiles of cells in order of their azimuth, so that they share the ground on the way, as many together as the
  /// memory holds.
  std::vector<std::vector<std::size_t>> segments(const Eye& eye, const std::vector<TileSet>& needed) const {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t tile = 0; tile < needed.size(); ++tile) {
      if (needed[tile].empty()) continue;
      const RasterGrid::Cell cell{static_cast<std::int64_t>(tile) % tiles_.columns(),
                                  static_cast<std::int64_t>(tile) / tiles_.columns()};
      const Point2 centre = tiles_.centre(cell.column, cell.row);
      order.emplace_back(std::atan2(centre.x - eye.position.x, centre.y - eye.position.y), tile);
    }
    std::sort(order.begin(), order.end());
    std::vector<std::vector<std::size_t>> result;
    TileSet together(ground_->count());
    for (const auto& [azimuth, tile] : order) {
      TileSet wider = together;
      wider |= needed[tile];
      if (result.empty() || ground_->points(wider) > budget_) {
        result.emplace_back();
        wider = needed[tile];
      }
      result.back().push_back(tile);
      together = std::move(wider);
    }
    return result;
  }

  void refine(const Eye& eye, const std::vector<std::size_t>& cells, const std::vector<TileSet>& needed,
              Refinement& refinement) {
    TileSet ground(ground_->count());
    for (const std::size_t tile : cells) ground |= needed[tile];
    EnvelopeRequest wanted{.window = ground_->window(ground), .level = 0, .discs = {}, .observers = {eye.position}};
    if (features_) wanted.themes = request_.themes;
    if (features_ && !request_.targets_on_surface) wanted.bare_ground = window_over(cells);
    Envelope envelope = envelop(store_, wanted, progress_);
    count(envelope);
    // The edges of the window are no voids; lines behind voids were hidden in the coarse pass.
    const EnvelopeScene scene(std::move(envelope), request_, tiles_, Voids::kPass);
    refinement.judge(scene, eye, cells,
                     [&](std::size_t, const auto&, auto& values, const Doubtful& d) { walk(scene, d, values); });
  }

  Window window_over(const std::vector<std::size_t>& cells) const {
    std::vector<Window::Polygon> parts;
    for (const std::size_t i : cells) {
      const Point2 c = tiles_.centre(static_cast<std::int64_t>(i) % tiles_.columns(),
                                     static_cast<std::int64_t>(i) / tiles_.columns());
      const double w = tiles_.cell_width() / 2, h = tiles_.cell_height() / 2;
      parts.push_back({{{c.x - w, c.y - h}, {c.x + w, c.y - h}, {c.x + w, c.y + h}, {c.x - w, c.y + h}}, {}});
    }
    return Window::polygons(std::move(parts));
  }

  void finish() {
    Result& result = surveyed_.result;
    Observation::prepare(result);
    for (std::size_t i = 0; i < observations_.size(); ++i)
      observations_[i]->store(tile_at(result.grid, tiles_, i), result, result.cells);
  }

  const Store& store_;
  const Request& request_;
  bool features_;         ///< stand on the ground
  std::uint64_t budget_;  ///< points
  Progress& progress_;
  Surveyed surveyed_;
  RasterGrid tiles_;
  std::optional<GroundTiles> ground_;
  std::optional<EnvelopeScene> first_;
  std::vector<std::unique_ptr<Observation>> observations_;  ///< a tile
};

}  // namespace

Surveyed compute_precise(const Store& store, const Request& request, const PreciseOptions& options,
                         Progress& progress) {
  return Precise(store, request, options, progress).run();
}

}  // namespace itin::viewshed
