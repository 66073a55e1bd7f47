#include "run/viewshed_cells.hpp"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <utility>

#include "line/infinity.hpp"

namespace itin::viewshed {

namespace {

/// Tells whether nothing of a tile is seen, where no more is asked of hidden cells.
bool is_hidden(const ExactJudge& judge, std::size_t eye, std::size_t tile, const Observation& observation) {
  return !observation.asks_of_the_hidden() && judge.hides(eye, tile);
}

}  // namespace

ViewshedCells::ViewshedCells(Result& result, const CellSink& sink, Progress& progress)
    : result_(result),
      sink_(sink),
      tiles_(grid_of_tiles(result.grid)),
      order_(order_of_tiles()),
      stage_("sight lines", result.request.observers.size() * result.grid.cell_count(), progress),
      modes_(result.request),
      observations_(tiles_.cell_count()),
      counts_(tiles_.cell_count()) {
  Observation::prepare(result);
}

std::vector<std::size_t> ViewshedCells::order_of_tiles() const {
  std::vector<std::size_t> order(tiles_.cell_count());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (!sink_) return order;
  std::vector<double> distances;
  for (const std::size_t tile : order) {
    const Box cells = box_of(result_.grid, tile_at(result_.grid, tiles_, tile));
    double nearest = kInfinity;
    for (const Observer& o : result_.request.observers)
      nearest = std::min(nearest, squared_distance(o.position, cells));
    distances.push_back(nearest);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return distances[a] < distances[b]; });
  return order;
}

Observation& ViewshedCells::of_tile(std::size_t tile) {
  std::unique_ptr<Observation>& observation = observations_[tile];
  if (!observation) observation = modes_.of_tile();
  return *observation;
}

void ViewshedCells::observe(const Portion& portion) {
  std::atomic<std::uint64_t> lines = 0;
  for_each(portion.cells.size(), [&](std::size_t i) {
    const PartsOfTile& cells = portion.cells[i];
    lines += observe(portion, cells);
    if (portion.last) store(cells.tile);
    return portion.judge.eye_count() * cell_count(cells.parts);
  });
  result_.statistics.lines += lines;
}

std::uint64_t ViewshedCells::observe(const Portion& portion, const PartsOfTile& cells) {
  const auto& [tile, parts] = cells;
  Observation& observation = of_tile(tile);
  std::unique_ptr<ExactJudge::ExactWork> work;
  std::uint64_t lines = 0;
  for (const std::size_t eye : eyes_near(portion.judge, tile)) {
    if (is_hidden(portion.judge, eye, tile, observation)) {
      lines += observation.hide(tile_at(result_.grid, tiles_, tile), parts);
      continue;
    }
    if (!work) work = portion.judge.begin_exactly(tile, parts);
    const auto observer = static_cast<std::uint32_t>(portion.first + eye);
    lines += observation.observe({*work, eye, observer, portion.studies});
  }
  return lines;
}

/// Returns the eyes that reach the tile, the nearest first: they most often settle what is asked of the others.
std::vector<std::size_t> ViewshedCells::eyes_near(const ExactJudge& judge, std::size_t tile) const {
  const Box centres = box_of_centres(result_.grid, tile_at(result_.grid, tiles_, tile));
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < judge.eye_count(); ++i) {
    const double squared = squared_distance(judge.eye(i).position, centres);
    if (judge.eye(i).view.reaches(squared)) order.emplace_back(squared, i);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> eyes;
  for (const auto& [squared, eye] : order) eyes.push_back(eye);
  return eyes;
}

void ViewshedCells::judge(const TileJudge& judge, std::span<const PartsOfTile> cells) {
  std::atomic<std::uint64_t> lines = 0;
  for_each(cells.size(), [&](std::size_t i) {
    const Tile tile = tile_at(result_.grid, tiles_, cells[i].tile);
    Observation& observation = of_tile(cells[i].tile);
    const auto open = [&](std::size_t, TileValues<Verdict>& values) {
      bool any = false;
      for_each_cell(cells[i], tile, [&](std::size_t cell) {
        if (observation.sees(cell)) return;
        values[cell] = Verdict::kUndecided;
        any = true;
      });
      return any;
    };
    const auto close = [&](std::size_t, const TileValues<Verdict>& values, auto&) { observation.add(values); };
    lines += judge_tile(judge, cells[i].tile, 1, open, close);
    return cell_count(cells[i].parts);
  });
  result_.statistics.lines += lines;
}

void ViewshedCells::advance_past(std::size_t eyes) {
  stage_.advance_to(eyes * result_.grid.cell_count());
}

void ViewshedCells::finish() {
  for (const std::size_t tile : order_) store(tile);
  for (const CellCounts& counts : counts_) result_.cells += counts;
  result_.cells.outside = result_.grid.cell_count() - result_.cells.in_view();
  modes_.finish(result_);
}

/// Stores a tile that has not been stored. One that nobody looks at has no observation, and is outside already.
void ViewshedCells::store(std::size_t tile) {
  if (!observations_[tile]) return;
  const Tile cells = tile_at(result_.grid, tiles_, tile);
  std::exchange(observations_[tile], nullptr)->store(cells, result_, counts_[tile]);
  if (!sink_) return;
  const std::lock_guard lock(sinking_);
  sink_(result_, {{cells.column, cells.row}, cells.columns, cells.rows});
}

}  // namespace itin::viewshed
