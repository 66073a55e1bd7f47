#include "certify/certified_blocks.hpp"

#include <memory>
#include <optional>
#include <utility>

#include <itin/call_progress.hpp>
#include <viewshed/surface.hpp>

#include "certify/certified_cells.hpp"
#include "certify/surroundings.hpp"
#include "judge/block_judge.hpp"
#include "line/tile_parts.hpp"
#include "progress/stage.hpp"
#include "progress/stopwatch.hpp"
#include "request/request.hpp"
#include "window/retrieval.hpp"

namespace itin::viewshed {

namespace {

std::vector<PartsOfTile> tiles_in_reach(const Eye& eye, const RasterGrid& grid, const RasterGrid& tiles) {
  std::vector<std::size_t> within;
  for (std::size_t i = 0; i < tiles.cell_count(); ++i) {
    const Tile tile = tile_at(grid, tiles, i);
    if (eye.view.reaches(squared_distance(eye.position, box_of_centres(grid, tile)))) within.push_back(i);
  }
  return all_cells(grid, tiles, within);
}

}  // namespace

ViewshedWithSurface certify_by_blocks(const Store& store, const Request& request, Progress& progress) {
  ViewshedWithSurface computed;
  Result& result = computed.result;
  result.request = request;
  result.certified = true;
  computed.whole = false;
  Stopwatch watch;
  const std::vector<Eye> eyes = eyes_on_surface(store, request, Detail::tolerance(0), result.ground_m, progress);
  EnvelopeRequest wanted = certified_request(store, request);
  wanted.observers.clear();  // rays would begin there, and none is cast
  CallProgress call(progress);
  Envelope envelope = envelop(store, wanted, call.step(0.4));
  result.statistics.add_retrieval(envelope.lower.statistics, envelope.lower.triangles.size(), watch.lap());

  result.grid = cells_of(request, extent_of(store));
  const RasterGrid tiles = grid_of_tiles(result.grid);
  const TargetRises rises(store, request, result.grid);
  BoundedEnvelope bounded(std::move(envelope), tiles, rises);
  result.statistics.scene_seconds = watch.lap();

  const std::size_t count = result.grid.cell_count();
  Stage stage("cells judged", eyes.size() * count, call.step(1));
  CertifiedCells cells(result.grid, tiles, stage);
  const Surroundings surroundings(store, request, result.grid);
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    bounded.bound_for(eyes[i]);
    const auto nearby = surroundings.decide(request.observers[i], result.statistics, progress);
    const BlockJudge judge(bounded, request, result.grid, tiles, eyes[i], nearby ? &*nearby : nullptr);
    cells.judge(judge, tiles_in_reach(eyes[i], result.grid, tiles));
    stage.advance_to((i + 1) * count);
  }
  cells.store(result);
  result.statistics.lines_seconds = watch.lap();
  computed.surface = std::make_shared<Surface>(Surface{bounded.envelope().lower, nullptr, {}});
  return computed;
}

}  // namespace itin::viewshed
