#include "exact/tin_segments.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include <itin/call_progress.hpp>
#include <itin/level_choice.hpp>
#include <itin/silent_progress.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/surface.hpp>
#include <viewshed/viewshed.hpp>

#include "bounds/boundary.hpp"
#include "exact/coarse_pass.hpp"
#include "judge/exact_judge.hpp"
#include "line/tile_parts.hpp"
#include "plan/azimuth_order.hpp"
#include "plan/ground_runs.hpp"
#include "plan/ground_tiles.hpp"
#include "plan/memory.hpp"
#include "progress/stopwatch.hpp"
#include "request/request.hpp"
#include "request/request_window.hpp"
#include "request/void_shadow.hpp"
#include "run/eye_verdicts.hpp"
#include "run/surface_source.hpp"
#include "scene/exact_scene.hpp"
#include "window/retrieval.hpp"

namespace itin::viewshed {

namespace {

/// How many times fewer points the coarse pass reads than the surface has.
constexpr std::uint64_t kCoarseShareOfRays = 12, kCoarseShareOfBlocks = 30;
/// About the share of the time that the coarse pass takes.
constexpr double kCoarsePass = 0.1;

class TinSegments final : public SurfaceSource {
 public:
  TinSegments(const Store& store, const Request& request, std::uint64_t memory, const Progress& progress)
      : store_(store),
        request_(request),
        features_(has_raised_features(store, request)),
        level_(level_within(store.metadata(), request.detail.coarsest())),
        way_(coarse_way(store, request)),
        box_(box_of_window(store, request)),
        memory_(memory),
        reading_(progress) {}

  std::vector<Eye> begin(Result& result, CallProgress& call) override {
    std::vector<Eye> eyes = eyes_on_surface(store_, request_, request_.detail, result.ground_m, call);
    retrieve_coarse(result, call.step(kCoarsePass));
    return eyes;
  }

  bool decide(const EyeGroup& group, ViewshedCells& cells) override {
    observe_from(group.eyes.front(), group, cells);
    return true;
  }

  /// The surface that maps are drawn over.
  std::shared_ptr<RetrievedSurface> coarse() const { return coarse_; }

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

  Tin triangulated(const Window& window, const ThemeChoice& themes, Statistics& statistics) {
    Tin tin = triangulate(store_, window, request_.detail, reading_, themes);
    statistics.retrieval += tin.statistics;
    statistics.retrieval_seconds += watch_.lap();
    return tin;
  }

  /// Retrieves the surface over `window`, and the ground over the tiles of the targets, where these stand on it.
  OwnedScene retrieve(const Window& window, const std::vector<std::size_t>& tiles, Result& result) {
    Statistics& statistics = result.statistics;
    Tin tin = triangulated(window, features_ ? request_.themes : ThemeChoice::none(), statistics);
    std::optional<Tin> ground;
    if (features_ && !request_.targets_on_surface)
      ground = triangulated(window_over(tiles), ThemeChoice::none(), statistics);
    statistics.triangles += tin.triangles.size();
    return {{std::move(tin), nullptr, {}}, std::move(ground), request_.earth, result.grid, tiles_,
            casts_rays(request_)};
  }

  void retrieve_coarse(Result& result, Progress& progress) {
    EnvelopeRequest wanted = certified_request(store_, request_, coarse_level(), enclosed_level());
    if (features_ && way_ == CoarseWay::kRays) wanted.enclosed = request_.themes;
    Envelope envelope = envelop(store_, wanted, progress);
    result.statistics.add_retrieval(envelope.lower.statistics, envelope.lower.triangles.size(), watch_.lap());
    result.grid = cells_of(request_, extent_of(store_));
    tiles_ = grid_of_tiles(result.grid);
    rim_ = rim_of(envelope.lower, envelope.outline);
    find_voids(envelope.lower.grid, rim_, result);
    ground_.emplace(store_, level_within(store_.metadata(), request_.detail.finest()), envelope.lower.bounds());
    coarse_ = std::make_shared<RetrievedSurface>(RetrievedSurface{envelope.lower, nullptr, {}});
    pass_ = make_coarse_pass(way_, std::move(envelope), {request_, *ground_, rim_, tiles_, result});
    result.statistics.scene_seconds += watch_.lap();
  }

  void observe_from(const Eye& eye, const EyeGroup& group, ViewshedCells& cells) {
    Result& result = cells.result();
    EyeVerdicts verdicts(cells, store_.metadata().grid, eye, group.first);
    const CoarsePass::Left left = pass_->decide(eye, verdicts);
    // The memory is free for the segments, when no other observer needs it.
    if (group.last) pass_.reset();
    for (const auto& [tiles, ground] : segments(eye, left.needed)) {
      result.statistics.lines_seconds += watch_.lap();
      const OwnedScene segment = retrieve(ground_->window(ground), tiles, result);
      // The edges of a segment's window are no voids, and features never reach beyond the ground.
      const ExactJudge judge(segment.full, {eye, segment.full.view_from(eye), left.shadow});
      if (way_ == CoarseWay::kNothing) {
        study({judge, group.first}, tiles, segment, ground, cells);
      } else {
        verdicts.judge(judge, tiles);
      }
    }
    if (way_ != CoarseWay::kNothing) verdicts.add();
    result.statistics.lines_seconds += watch_.lap();
  }

  /// Observes tiles over the segment with the studies of triangles that the mode needs.
  void study(Portion portion, const std::vector<std::size_t>& tiles, const OwnedScene& segment, const TileSet& ground,
             ViewshedCells& cells) {
    std::optional<Tin> bare;
    if (features_ && needs_bare_lines(request_))
      bare = triangulated(ground_->window(ground), ThemeChoice::none(), cells.result().statistics);
    const TriangleFinders finders(segment.surface.tin);
    std::optional<TriangleFinders> bare_finders;
    if (bare) bare_finders.emplace(*bare);
    std::optional<TriangleStudies> studies;
    if (needs_triangles(request_))
      studies.emplace(request_, finders, bare_finders ? &*bare_finders : nullptr, cells.progress());
    portion.studies = studies ? &*studies : nullptr;
    cells.observe(portion, all_cells(cells.result().grid, tiles_, tiles));
  }

  /// Returns runs of tiles of cells next to each other in azimuth, as many tiles together as the memory holds.
  std::vector<GroundRun> segments(const Eye& eye, const std::vector<TileSet>& needed) const {
    std::vector<std::size_t> order;
    for (std::size_t tile = 0; tile < needed.size(); ++tile)
      if (!needed[tile].empty()) order.push_back(tile);
    const auto centre = [&](std::size_t tile) {
      const RasterGrid::Cell cell = place_of(tiles_, tile);
      return tiles_.centre(cell.column, cell.row);
    };
    sort_by_azimuth(eye.position, centre, order);
    return ground_runs(
        order, ground_->count(), [&](std::size_t tile) -> const TileSet& { return needed[tile]; },
        [&](const TileSet& ground) { return ground_->points(ground) <= budget(); });
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
  std::uint64_t memory_;    ///< bytes, without the rasters
  SilentProgress reading_;  ///< while a segment is read
  Stopwatch watch_;
  std::shared_ptr<RetrievedSurface> coarse_;
  RasterGrid tiles_;
  std::vector<RimEdge> rim_;  ///< where ground ends
  std::optional<GroundTiles> ground_;
  std::unique_ptr<CoarsePass> pass_;
};

}  // namespace

bool reads_what_may_be_seen(const Store& store, const Request& request) {
  return coarse_way(store, request) == CoarseWay::kBlocks;
}

ViewshedWithSurface compute_in_tin_segments(const Store& store, const Request& request, std::uint64_t memory,
                                            const CellSink& sink, Progress& progress) {
  TinSegments source(store, request, memory, progress);
  Result result = *run(source, request, sink, progress);
  return {source.coarse(), std::nullopt, false, std::move(result)};
}

}  // namespace itin::viewshed
