#include "run/viewshed_cells.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>
#include <utility>

#include "line/infinity.hpp"

namespace itin::viewshed {

namespace {

/// How many columns and rows apart the cells of the passes before the last are.
constexpr std::array<std::int64_t, 2> kCoarseSteps{9, 3};

/// Tells whether nothing of a tile is seen, where no more is asked of hidden cells.
bool is_hidden(const ExactJudge& judge, std::size_t eye, const Tile& tile, const Observation& observation) {
  return !observation.asks_of_the_hidden() && judge.hides(eye, tile);
}

}  // namespace

ViewshedCells::ViewshedCells(Result& result, const CellSink& sink, bool in_passes, Progress& progress)
    : result_(result),
      sink_(sink),
      progress_(progress),
      tiles_(grid_of_tiles(result.grid)),
      stage_("sight lines", result.request.observers.size() * result.grid.cell_count(), progress),
      modes_(result.request),
      counts_(tiles_.cell_count()) {
  if (sink && in_passes)
    for (const std::int64_t step : kCoarseSteps) passes_.push_back(pass(step));
  passes_.push_back(pass(1));
  Observation::prepare(result);
}

ViewshedCells::Pass ViewshedCells::pass(std::int64_t step) const {
  const SteppedTiles tiles(result_.grid, step);
  Pass pass{tiles, step == 1, order_of(tiles)};
  pass.observations.resize(tiles.count());
  return pass;
}

std::vector<std::size_t> ViewshedCells::order_of(const SteppedTiles& tiles) const {
  std::vector<std::size_t> order(tiles.count());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (!sink_) return order;
  std::vector<double> distances;
  for (const std::size_t tile : order) {
    const Box cells = box_of(result_.grid, tiles.tile(tile));
    double nearest = kInfinity;
    for (const Observer& o : result_.request.observers)
      nearest = std::min(nearest, squared_distance(o.position, cells));
    distances.push_back(nearest);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return distances[a] < distances[b]; });
  return order;
}

Observation& ViewshedCells::of_tile(Pass& pass, std::size_t tile) {
  std::unique_ptr<Observation>& observation = pass.observations[tile];
  if (!observation) observation = modes_.of_tile();
  return *observation;
}

void ViewshedCells::observe_all(const Portion& portion) {
  for (Pass& pass : passes_) {
    std::vector<PartsOfTile> cells;
    for (const std::size_t tile : pass.order) cells.push_back({tile, {pass.tiles.tile(tile)}});
    observe(portion, pass, cells);
  }
}

/// The coarse passes' steps and sight lines do not count: the last pass makes them all.
void ViewshedCells::observe(const Portion& portion, Pass& pass, std::span<const PartsOfTile> cells) {
  std::atomic<std::uint64_t> lines = 0;
  for_each(cells.size(), [&](std::size_t i) {
    lines += observe(portion, pass, cells[i]);
    if (portion.last) store(pass, cells[i].tile);
    return pass.last ? portion.judge.eye_count() * cell_count(cells[i].parts) : 0;
  });
  if (pass.last) result_.statistics.lines += lines;
}

std::uint64_t ViewshedCells::observe(const Portion& portion, Pass& pass, const PartsOfTile& cells) {
  const std::vector<Tile>& parts = cells.parts;
  const Tile tile = pass.tiles.tile(cells.tile);
  Observation& observation = of_tile(pass, cells.tile);
  std::unique_ptr<ExactJudge::ExactWork> work;
  std::uint64_t lines = 0;
  for (const std::size_t eye : eyes_near(portion.judge, tile)) {
    if (is_hidden(portion.judge, eye, tile, observation)) {
      lines += observation.hide(tile, parts);
      continue;
    }
    if (!work) work = portion.judge.begin_exactly(tile, parts);
    const auto observer = static_cast<std::uint32_t>(portion.first + eye);
    lines += observation.observe({*work, eye, observer, progress_, portion.studies});
  }
  return lines;
}

/// Returns the eyes that reach the tile, the nearest first: they most often settle what is asked of the others.
std::vector<std::size_t> ViewshedCells::eyes_near(const ExactJudge& judge, const Tile& tile) const {
  const Box centres = box_of_centres(result_.grid, tile);
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
      for_each_cell(cells[i].parts, tile, [&](std::size_t cell) {
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
  Pass& all = passes_.back();
  for (const std::size_t tile : all.order) store(all, tile);
  for (const CellCounts& counts : counts_) result_.cells += counts;
  result_.cells.outside = result_.grid.cell_count() - result_.cells.in_view();
  modes_.finish(result_);
}

/// Stores a tile that has not been stored. One that nobody looks at has no observation, and is outside already.
void ViewshedCells::store(Pass& pass, std::size_t tile) {
  if (!pass.observations[tile]) return;
  const Tile cells = pass.tiles.tile(tile);
  CellCounts not_counted;
  std::exchange(pass.observations[tile], nullptr)->store(cells, result_, pass.last ? counts_[tile] : not_counted);
  if (!sink_) return;
  const std::lock_guard lock(sinking_);
  sink_(result_, {{cells.column, cells.row}, cells.columns, cells.rows, cells.step});
}

}  // namespace itin::viewshed
