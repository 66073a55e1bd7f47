#include "compute/certified.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/level_choice.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/surface.hpp>
#include <viewshed/viewshed.hpp>

#include "certify/certified_cells.hpp"
#include "certify/certified_sectors.hpp"
#include "judge/envelope_judge.hpp"
#include "plan/sight_sectors.hpp"
#include "progress/stage.hpp"
#include "progress/stopwatch.hpp"
#include "request/request.hpp"
#include "window/retrieval.hpp"

namespace itin::viewshed {

namespace {

/// The exact answer, but where ground without data leaves it open.
Surveyed decide_exactly(const Store& store, const Request& request, const ComputeOptions& options, Progress& progress) {
  Request exact = request;
  exact.detail = Detail::tolerance(0);
  Surveyed surveyed = compute_with_surface(store, exact, options, progress);
  surveyed.result.request = request;
  surveyed.result.certified = true;
  return surveyed;
}

/// The part of the level read at a time does not depend on the memory, or what it leaves undecided would depend on it,
/// too.
void require_memory(const Store& store, const Request& request, CertifiedWay way, std::uint64_t memory) {
  constexpr std::uint64_t kBytesPerPointOfLevel = 715;
  const int level = level_within(store.metadata(), request.detail.coarsest());
  const std::uint64_t points =
      way == CertifiedWay::kBySectors ? kPointsOfSector : store.points_about(level, box_of_window(store, request));
  if (points * kBytesPerPointOfLevel > memory)
    throw InputError(
        fmt::format("the level takes {:.0f} MB at a time: give more `memory_bytes`, a coarser tolerance or "
                    "a smaller `radius`",
                    static_cast<double>(points * kBytesPerPointOfLevel) / 1e6));
}

}  // namespace

Surveyed compute_certified(const Store& store, const Request& request, const ComputeOptions& options,
                           Progress& progress) {
  return compute_certified(store, request, certified_way(store, request), options, progress);
}

Surveyed compute_certified(const Store& store, const Request& request, CertifiedWay way, const ComputeOptions& options,
                           Progress& progress) {
  validate_certified(request);
  if (way == CertifiedWay::kExactly) return decide_exactly(store, request, options, progress);
  require_memory(store, request, way, options.memory_bytes);
  if (way == CertifiedWay::kBySectors)
    return certify_by_sectors(store, request, voids_of(request), kPointsOfSector, progress);
  Surveyed surveyed;
  Result& result = surveyed.result;
  result.request = request;
  result.certified = true;
  surveyed.whole = false;
  Stopwatch watch;
  const std::vector<Eye> eyes = eyes_on_surface(store, request, Detail::tolerance(0), result.ground_m, progress);
  Envelope envelope = envelop(store, certified_request(store, request), progress);
  result.statistics.retrieval = envelope.lower.statistics;
  result.statistics.triangles = envelope.lower.triangles.size();
  result.statistics.retrieval_seconds = watch.lap();

  progress.report("scene", 0);
  result.grid = cells_of(request, extent_of(store));
  const RasterGrid tiles = grid_of_tiles(result.grid);
  const EnvelopeScene scene(std::move(envelope), request, tiles, voids_of(request));
  const EnvelopeJudge judge(scene, result.grid, tiles, eyes);
  result.statistics.scene_seconds = watch.lap();

  Stage stage("cells judged", eyes.size() * result.grid.cell_count(), progress);
  CertifiedCells cells(result.grid, tiles, stage);
  cells.judge(judge, eyes.size(), all_cells(result.grid, tiles));
  cells.store(result);
  result.statistics.lines_seconds = watch.lap();
  surveyed.surface = std::make_shared<Surface>(Surface{scene.envelope.lower, nullptr, {}});
  return surveyed;
}

}  // namespace itin::viewshed
