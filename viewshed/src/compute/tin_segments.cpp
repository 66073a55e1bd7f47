#include "compute/tin_segments.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include <itin/call_progress.hpp>
#include <itin/level_choice.hpp>
#include <itin/parallel.hpp>
#include <itin/silent_progress.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/surface.hpp>
#include <viewshed/viewshed.hpp>

#include "judge/envelope_judge.hpp"
#include "judge/exact_judge.hpp"
#include "line/tile_parts.hpp"
#include "modes/observe.hpp"
#include "plan/azimuth_order.hpp"
#include "plan/ground_tiles.hpp"
#include "plan/memory.hpp"
#include "plan/partition.hpp"
#include "progress/stage.hpp"
#include "progress/stopwatch.hpp"
#include "request/request.hpp"
#include "scene/full_surface.hpp"
#include "window/retrieval.hpp"

namespace itin::viewshed {

namespace {

/// An envelope has two surfaces and two scenes; and half of the memory is for what is refined meanwhile.
constexpr std::uint64_t kBytesPerEnvelopePoint = 2400;
/// The coarse pass reads so much less than the full surface.
constexpr std::uint64_t kCoarseShare = 12;
/// Its share of the time, about.
constexpr double kCoarsePass = 0.1;

Point2 along(const Grid& grid, const SightLines& lines, unsigned i, double s) {
  return {grid.origin.x + (lines.from_x[i] + s * (lines.to_x[i] - lines.from_x[i])) * grid.resolution,
          grid.origin.y + (lines.from_y[i] + s * (lines.to_y[i] - lines.from_y[i])) * grid.resolution};
}

class TinSegments {
 public:
  TinSegments(const Store& store, const Request& request, std::uint64_t memory, Progress& progress)
      : store_(store),
        request_(request),
        features_(has_raised_features(store, request)),
        full_(level_within(store.metadata(), request.detail.coarsest()) == 0),
        box_(box_of_window(store, request)),
        memory_(memory),
        progress_(progress),
        reading_(progress) {}

  ViewshedWithSurface run() {
    Result& result = computed_.result;
    result.request = request_;
    computed_.whole = false;
    const std::vector<Eye> eyes = eyes_on_surface(store_, request_, request_.detail, result.ground_m, progress_);
    progress_.step(kCoarsePass);
    retrieve_coarse();
    Observations observations(request_);
    observations_ = observations.of_tiles(tiles_);
    stage_.emplace("cells decided", eyes.size() * result.grid.cell_count(), progress_.step(1));
    for (std::uint32_t i = 0; i < eyes.size(); ++i) observe_from(eyes[i], i);
    store_all(observations_, tiles_, result);
    observations.finish(result);
    result.statistics.lines_seconds += watch_.lap();
    return std::move(computed_);
  }

 private:
  /// Certificates know nothing of coarser surfaces, and cells that a coarse level decides have no exact height of
  /// ground.
  bool whole_lines() const {
    return !full_ || needs_triangles(request_) || request_.mode == Mode::kHeight || request_.mode == Mode::kAngle;
  }

  std::uint64_t budget() const { return memory_ / bytes_per_point(request_); }

  int coarse_level() const {
    const std::uint64_t most = std::min(memory_ / kBytesPerEnvelopePoint, store_.points_about(0, box_) / kCoarseShare);
    return finest_level_of(store_, box_, most, 1);
  }

  Tin triangulated(const Window& window, const ThemeChoice& themes) {
    Tin tin = triangulate(store_, window, request_.detail, reading_, themes);
    Statistics& statistics = computed_.result.statistics;
    statistics.retrieval += tin.statistics;
    statistics.retrieval_seconds += watch_.lap();
    return tin;
  }

  /// `targets` is where they stand.
  OwnedSurface retrieve(const Window& window, const Window& targets) {
    Tin tin = triangulated(window, features_ ? request_.themes : ThemeChoice::none());
    std::optional<Tin> ground;
    if (features_ && !request_.targets_on_surface) ground = triangulated(targets, ThemeChoice::none());
    Result& result = computed_.result;
    result.statistics.triangles += tin.triangles.size();
    return {{std::move(tin), nullptr, {}},
            std::move(ground),
            request_.earth,
            result.grid,
            tiles_,
            casts_rays(request_) ? positions_of(request_) : std::vector<Point2>()};
  }

  void retrieve_coarse() {
    EnvelopeRequest wanted = certified_request(store_, request_, coarse_level());
    if (features_ && !whole_lines()) wanted.enclosed = request_.themes;
    Envelope envelope = envelop(store_, wanted, progress_);
    Result& result = computed_.result;
    result.statistics.retrieval += envelope.lower.statistics;
    result.statistics.triangles += envelope.lower.triangles.size();
    result.statistics.retrieval_seconds += watch_.lap();
    result.grid = cells_of(request_, extent_of(store_));
    tiles_ = grid_of_tiles(result.grid);
    rim_ = rim_of(envelope.lower, envelope.outline);
    find_voids(envelope.lower.grid, rim_, result);
    ground_.emplace(store_, level_within(store_.metadata(), request_.detail.finest()), envelope.lower.bounds());
    computed_.surface = std::make_shared<Surface>(Surface{envelope.lower, nullptr, {}});
    if (!whole_lines()) coarse_.emplace(std::move(envelope), request_, tiles_, missing_ground_rule(request_));
    result.statistics.scene_seconds += watch_.lap();
  }

  void observe_from(const Eye& eye, std::uint32_t observer) {
    if (whole_lines()) {
      observe_over_lines(eye, observer);
    } else {
      observe_certified(eye, observer);
    }
    stage_->advance_to((observer + 1) * computed_.result.grid.cell_count());
  }

  /// All ground under all lines.
  void observe_over_lines(const Eye& eye, std::uint32_t observer) {
    Result& result = computed_.result;
    const std::vector<TileSet> needed = under_lines(eye, observer);
    // The edges of a segment's window are no voids, and features never reach beyond the ground.
    const auto shadow = shadow_of(eye, rim_, result);
    for (const auto& [cells, ground] : segments(eye, needed)) {
      const OwnedSurface segment = refine(cells, ground);
      std::optional<Tin> bare;
      if (features_ && needs_bare_lines(request_)) bare = triangulated(ground_->window(ground), ThemeChoice::none());
      std::optional<TriangleStudies> studies;
      if (needs_triangles(request_)) studies.emplace(request_, segment.surface.tin, bare ? &*bare : nullptr);
      const ExactJudge judge(segment.full, {eye, segment.full.view_from(eye), shadow});
      result.statistics.lines += observe(judge, observer, all_cells(result.grid, tiles_, cells), observations_,
                                         studies ? &*studies : nullptr, *stage_);
    }
  }

  /// One observer's verdicts on each tile, on their way.
  using TileVerdicts = std::vector<TileValues<Verdict>>;

  void observe_certified(const Eye& eye, std::uint32_t observer) {
    TileVerdicts verdicts(tiles_.cell_count());
    for (TileValues<Verdict>& values : verdicts) values.fill(Verdict::kOutside);
    for_each_view(eye, observer, [&](std::size_t tile, const CellView& view) {
      if (observations_[tile]->open(view)) verdicts[tile][view.cell] = Verdict::kUndecided;
    });
    const auto [needed, shadow] = coarse_pass(eye, verdicts);
    // The scene's memory is free for the segments, when no other observer needs it.
    if (observer + 1 == request_.observers.size()) coarse_.reset();
    for (const auto& [cells, ground] : segments(eye, needed)) {
      const OwnedSurface segment = refine(cells, ground);
      // The edges of the window are no voids.
      judge_undecided(ExactJudge(segment.full, {eye, segment.full.view_from(eye), shadow}), cells, verdicts);
    }
    for_each_view(eye, observer, [&](std::size_t tile, const CellView& view) {
      observations_[tile]->add(view, verdicts[tile][view.cell]);
    });
  }

  /// Judges what is undecided of these tiles, for the judge's only eye.
  void judge_undecided(const TileJudge& judge, const std::vector<std::size_t>& tiles, TileVerdicts& verdicts) {
    const auto undecided = [](const TileValues<Verdict>& values) {
      return static_cast<std::size_t>(std::count(values.begin(), values.end(), Verdict::kUndecided));
    };
    std::atomic<std::uint64_t> lines = 0;
    stage_->for_each(tiles.size(), [&](std::size_t i) {
      TileValues<Verdict>& values = verdicts[tiles[i]];
      const std::size_t before = undecided(values);
      lines += judge.begin(tiles[i])->judge(0, values);
      return before - undecided(values);
    });
    computed_.result.statistics.lines += lines;
  }

  /// Calls visit(tile, view) for every cell; the views know no heights.
  template <class Visit>
  void for_each_view(const Eye& eye, std::uint32_t observer, const Visit& visit) const {
    const RasterGrid& grid = computed_.result.grid;
    parallel_for(observations_.size(), [&](std::size_t i) {
      const Tile tile = tile_at(grid, tiles_, i);
      const TileCentres centres(store_.metadata().grid, grid, tile);
      for_each_cell(tile, [&](std::size_t cell, RasterGrid::Cell place) {
        const auto [dx, dy] = eye.offset_to(grid.centre(place.column, place.row), centres.at(cell));
        visit(i, CellView{cell, observer, dx, dy, 0});
      });
    });
  }

  struct Coarse {
    std::vector<TileSet> needed;  ///< the ground that each tile's undecided lines need at full detail
    std::shared_ptr<const VoidShadow> shadow;
  };

  Coarse coarse_pass(const Eye& eye, TileVerdicts& verdicts) {
    std::vector<std::size_t> all(tiles_.cell_count());
    std::iota(all.begin(), all.end(), std::size_t{0});
    std::vector<TileSet> needed(all.size());
    const EnvelopeJudge judge(*coarse_, computed_.result.grid, tiles_, {eye},
                              [&](std::size_t tile, const EnvelopePacket& packet) {
                                if (needed[tile].empty()) needed[tile] = TileSet(ground_->count());
                                add_ground(packet, needed[tile]);
                              });
    judge_undecided(judge, all, verdicts);
    return {std::move(needed), judge.view(0).shadow};
  }

  /// Under the targets, and where lines come near it.
  void add_ground(const EnvelopePacket& packet, TileSet& tiles) const {
    const Grid& units = store_.metadata().grid;
    UpperScene::Stretches stretches;
    coarse_->upper.find_stretches(packet.low, packet.starts_under, packet.ends_under, stretches);
    for_each_line(packet.low.active, [&](unsigned i) {
      const Point2 target = along(units, packet.low, i, 1);
      ground_->add_line(target, target, tiles);
      for (const Stretch& s : stretches[i])
        ground_->add_line(along(units, packet.low, i, s.from), along(units, packet.low, i, s.to), tiles);
    });
  }

  /// The ground under all lines in view to each tile's open cells.
  std::vector<TileSet> under_lines(const Eye& eye, std::uint32_t observer) const {
    constexpr double kAnyHeight = 1e9;
    std::vector<Box> targets(tiles_.cell_count());
    for_each_view(eye, observer, [&](std::size_t tile, const CellView& view) {
      const bool in_view = eye.view.contains(view.dx, view.dy, -kAnyHeight, kAnyHeight) != false;
      if (in_view && observations_[tile]->open(view))
        targets[tile].extend(Point2{eye.position.x + view.dx, eye.position.y + view.dy});
    });
    std::vector<TileSet> needed(tiles_.cell_count());
    parallel_for(needed.size(), [&](std::size_t tile) {
      if (targets[tile].empty()) return;
      needed[tile] = TileSet(ground_->count());
      ground_->add_lines(eye.position, targets[tile], needed[tile]);
    });
    return needed;
  }

  struct GroundSegment {
    std::vector<std::size_t> cells;  ///< tiles of them
    TileSet ground;                  ///< all that they need
  };

  /// Tiles of cells next to each other in azimuth, as many together as the memory holds.
  std::vector<GroundSegment> segments(const Eye& eye, const std::vector<TileSet>& needed) const {
    std::vector<std::size_t> order;
    for (std::size_t tile = 0; tile < needed.size(); ++tile)
      if (!needed[tile].empty()) order.push_back(tile);
    const auto centre = [&](std::size_t tile) {
      const RasterGrid::Cell cell = place_of(tiles_, tile);
      return tiles_.centre(cell.column, cell.row);
    };
    sort_by_azimuth(eye.position, centre, order);
    const auto fits = [&](const TileSet& ground) { return ground_->points(ground) <= budget(); };
    std::vector<GroundSegment> result;
    for (std::span<const std::size_t> left = order; !left.empty(); left = left.subspan(result.back().cells.size())) {
      const auto with = [&](TileSet ground, std::size_t i) { return ground |= needed[left[i]]; };
      auto run = longest_run(left.size(), TileSet(ground_->count()), with, fits);
      result.push_back({{left.begin(), left.begin() + static_cast<std::ptrdiff_t>(run.count)}, std::move(run.sum)});
    }
    return result;
  }

  OwnedSurface refine(const std::vector<std::size_t>& cells, const TileSet& ground) {
    computed_.result.statistics.lines_seconds += watch_.lap();
    return retrieve(ground_->window(ground), window_over(cells));
  }

  Window window_over(const std::vector<std::size_t>& cells) const {
    std::vector<Window::Polygon> parts;
    for (const std::size_t i : cells) parts.push_back(rectangle(box_of_cell(tiles_, place_of(tiles_, i))));
    return Window::polygons(std::move(parts));
  }

  const Store& store_;
  const Request& request_;
  bool features_;  ///< stand on the ground
  bool full_;      ///< the surface is the full one
  Box box_;
  std::uint64_t memory_;  ///< bytes, without the rasters
  CallProgress progress_;
  SilentProgress reading_;  ///< of a segment
  Stopwatch watch_;
  ViewshedWithSurface computed_;
  RasterGrid tiles_;
  std::vector<RimEdge> rim_;  ///< where ground ends
  std::optional<GroundTiles> ground_;
  std::optional<EnvelopeScene> coarse_;                     ///< unless whole lines are needed
  std::optional<Stage> stage_;                              ///< its steps are cells, of all observers
  std::vector<std::unique_ptr<Observation>> observations_;  ///< per tile
};

}  // namespace

ViewshedWithSurface compute_in_tin_segments(const Store& store, const Request& request, std::uint64_t memory,
                                            Progress& progress) {
  return TinSegments(store, request, memory, progress).run();
}

}  // namespace itin::viewshed
