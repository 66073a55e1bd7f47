#include "compute/tin_segments.hpp"

#include <algorithm>
#include <memory>
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

#include "bounds/boundary.hpp"
#include "compute/coarse_pass.hpp"
#include "judge/exact_judge.hpp"
#include "line/infinity.hpp"
#include "line/tile_parts.hpp"
#include "modes/observe.hpp"
#include "plan/azimuth_order.hpp"
#include "plan/ground_tiles.hpp"
#include "plan/memory.hpp"
#include "plan/partition.hpp"
#include "progress/stage.hpp"
#include "progress/stopwatch.hpp"
#include "request/cells_in_view.hpp"
#include "request/request.hpp"
#include "request/request_window.hpp"
#include "request/void_shadow.hpp"
#include "scene/full_surface.hpp"
#include "window/retrieval.hpp"

namespace itin::viewshed {

namespace {

/// How many times fewer points the coarse pass reads than the surface has.
constexpr std::uint64_t kCoarseShareOfRays = 12, kCoarseShareOfBlocks = 30;
/// About the share of the time that the coarse pass takes.
constexpr double kCoarsePass = 0.1;

class TinSegments {
 public:
  TinSegments(const Store& store, const Request& request, std::uint64_t memory, Progress& progress)
      : store_(store),
        request_(request),
        features_(has_raised_features(store, request)),
        level_(level_within(store.metadata(), request.detail.coarsest())),
        way_(coarse_way(store, request)),
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
  std::uint64_t budget() const { return memory_ / bytes_per_point(request_); }

  /// The level whose surface the coarse envelope encloses.
  int enclosed_level() const { return way_ == CoarseWay::kBlocks ? level_ : 0; }

  int coarse_level() const {
    const std::uint64_t share = way_ == CoarseWay::kBlocks ? kCoarseShareOfBlocks : kCoarseShareOfRays;
    // Half of the memory is for what is refined meanwhile.
    const std::uint64_t most =
        std::min(memory_ / 2 / kBytesPerCastEnvelopePoint, store_.points_about(enclosed_level(), box_) / share);
    return finest_level_of(store_, box_, most, std::max(enclosed_level(), 1));
  }

  Tin triangulated(const Window& window, const ThemeChoice& themes) {
    Tin tin = triangulate(store_, window, request_.detail, reading_, themes);
    Statistics& statistics = computed_.result.statistics;
    statistics.retrieval += tin.statistics;
    statistics.retrieval_seconds += watch_.lap();
    return tin;
  }

  /// Retrieves the surface over `window`, and the ground over `targets`, where targets stand on it.
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
    EnvelopeRequest wanted = certified_request(store_, request_, coarse_level(), enclosed_level());
    if (way_ != CoarseWay::kRays) wanted.observers.clear();
    if (features_ && way_ == CoarseWay::kRays) wanted.enclosed = request_.themes;
    Envelope envelope = envelop(store_, wanted, progress_);
    Result& result = computed_.result;
    result.statistics.add_retrieval(envelope.lower.statistics, envelope.lower.triangles.size(), watch_.lap());
    result.grid = cells_of(request_, extent_of(store_));
    tiles_ = grid_of_tiles(result.grid);
    rim_ = rim_of(envelope.lower, envelope.outline);
    find_voids(envelope.lower.grid, rim_, result);
    ground_.emplace(store_, level_within(store_.metadata(), request_.detail.finest()), envelope.lower.bounds());
    computed_.surface = std::make_shared<Surface>(Surface{envelope.lower, nullptr, {}});
    pass_ = make_coarse_pass(way_, std::move(envelope), {request_, *ground_, rim_, tiles_, result});
    result.statistics.scene_seconds += watch_.lap();
  }

  void observe_from(const Eye& eye, std::uint32_t observer) {
    Result& result = computed_.result;
    TileVerdicts verdicts = asked(eye, observer);
    const CoarsePass::Left left = pass_->decide(eye, verdicts, *stage_);
    result.statistics.lines += left.lines;
    // The memory is free for the segments, when no other observer needs it.
    if (observer + 1 == request_.observers.size()) pass_.reset();
    for (const auto& [cells, ground] : segments(eye, left.needed)) {
      const OwnedSurface segment = refine(cells, ground);
      // The edges of a segment's window are no voids, and features never reach beyond the ground.
      const ExactJudge judge(segment.full, {eye, segment.full.view_from(eye), left.shadow});
      result.statistics.lines += way_ == CoarseWay::kNothing ? study(judge, segment, observer, cells, ground)
                                                             : judge_undecided(judge, cells, verdicts, *stage_);
    }
    if (way_ != CoarseWay::kNothing) add(eye, observer, verdicts);
    stage_->advance_to((observer + 1) * result.grid.cell_count());
  }

  /// Studies what the mode asks of the lines to these tiles. Returns how many lines there were.
  std::uint64_t study(const ExactJudge& judge, const OwnedSurface& segment, std::uint32_t observer,
                      const std::vector<std::size_t>& cells, const TileSet& ground) {
    std::optional<Tin> bare;
    if (features_ && needs_bare_lines(request_)) bare = triangulated(ground_->window(ground), ThemeChoice::none());
    std::optional<TriangleStudies> studies;
    if (needs_triangles(request_)) studies.emplace(request_, segment.surface.tin, bare ? &*bare : nullptr);
    return observe(judge, observer, all_cells(computed_.result.grid, tiles_, cells), observations_,
                   studies ? &*studies : nullptr, *stage_);
  }

  void add(const Eye& eye, std::uint32_t observer, const TileVerdicts& verdicts) {
    parallel_for(verdicts.size(), [&](std::size_t i) {
      for_each_view(eye, observer, i,
                    [&](const CellView& view) { observations_[i]->add(view, verdicts[i][view.cell]); });
    });
  }

  /// Calls visit(view) for every cell of a tile; the views know no heights.
  template <class Visit>
  void for_each_view(const Eye& eye, std::uint32_t observer, std::size_t number, const Visit& visit) const {
    const RasterGrid& grid = computed_.result.grid;
    const Tile tile = tile_at(grid, tiles_, number);
    const TileCentres centres(store_.metadata().grid, grid, tile);
    for_each_offset(eye, grid, tile, centres, [&](std::size_t cell, const Point2& offset) {
      visit(CellView{cell, observer, offset.x, offset.y, 0});
    });
  }

  /// Returns Verdict::kUndecided for the open cells that the eye looks at, and Verdict::kOutside for others.
  TileVerdicts asked(const Eye& eye, std::uint32_t observer) const {
    const RasterGrid& grid = computed_.result.grid;
    const MapView field{eye.position, eye.view};
    TileVerdicts verdicts(tiles_.cell_count());
    parallel_for(verdicts.size(), [&](std::size_t i) {
      verdicts[i].fill(Verdict::kOutside);
      const Box centres = box_of_centres(grid, tile_at(grid, tiles_, i));
      if (!field.reaches(centres)) return;
      const bool all = field.holds(centres);
      for_each_view(eye, observer, i, [&](const CellView& view) {
        const bool in_view = all || eye.view.contains(view.dx, view.dy, -kInfinity, kInfinity) != false;
        if (in_view && observations_[i]->open(view)) verdicts[i][view.cell] = Verdict::kUndecided;
      });
    });
    return verdicts;
  }

  struct GroundSegment {
    std::vector<std::size_t> cells;  ///< the numbers of their tiles
    TileSet ground;                  ///< all ground that they need
  };

  /// Returns segments of tiles of cells next to each other in azimuth, as many tiles together as the memory holds.
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
    for (const std::size_t i : cells) parts.push_back(Window::rectangle(box_of_cell(tiles_, place_of(tiles_, i))));
    return Window::polygons(std::move(parts));
  }

  const Store& store_;
  const Request& request_;
  bool features_;  ///< whether features stand on the ground
  int level_;      ///< the surface's level, or its coarsest one
  CoarseWay way_;
  Box box_;
  std::uint64_t memory_;  ///< bytes, without the rasters
  CallProgress progress_;
  SilentProgress reading_;  ///< while a segment is read
  Stopwatch watch_;
  ViewshedWithSurface computed_;
  RasterGrid tiles_;
  std::vector<RimEdge> rim_;  ///< where ground ends
  std::optional<GroundTiles> ground_;
  std::unique_ptr<CoarsePass> pass_;
  std::optional<Stage> stage_;                              ///< its steps are cells, of all observers
  std::vector<std::unique_ptr<Observation>> observations_;  ///< per tile
};

}  // namespace

bool reads_what_may_be_seen(const Store& store, const Request& request) {
  return coarse_way(store, request) == CoarseWay::kBlocks;
}

ViewshedWithSurface compute_in_tin_segments(const Store& store, const Request& request, std::uint64_t memory,
                                            Progress& progress) {
  return TinSegments(store, request, memory, progress).run();
}

}  // namespace itin::viewshed
