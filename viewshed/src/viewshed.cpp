#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include <itin/parallel.hpp>
#include <viewshed/viewshed.hpp>

#include "boundary.hpp"
#include "eye.hpp"
#include "field_of_view.hpp"
#include "request.hpp"
#include "scene.hpp"
#include "stopwatch.hpp"
#include "surface_heights.hpp"
#include "triangle_bins.hpp"

namespace itin::viewshed {

namespace {

/// The elevation under an observer on a surface that is not the scene's.
std::optional<double> height_on(const Tin& tin, Point2 position) {
  std::vector<std::uint32_t> all(tin.triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  const std::optional<double> units = surface_height(tin, all, position);
  return units ? std::optional(*units * tin.grid.resolution) : std::nullopt;
}

/// Decides tiles of cells. Tiles are independent of each other.
class Caster {
 public:
  Caster(const Tin& tin, const Scene& scene, std::vector<Eye> eyes, const TriangleBins& bins, const RasterGrid& tiles,
         Result& result)
      : tin_(tin),
        scene_(scene),
        eyes_(std::move(eyes)),
        bins_(bins),
        tiles_(tiles),
        result_(result),
        view_(result.request),
        grazing_(kGrazing / tin.grid.resolution) {}

  void run(Progress& progress) {
    const std::size_t count = tiles_.cell_count();
    std::atomic<std::size_t> done = 0;
    std::vector<Tally> tallies(count);
    parallel_for(count, [&](std::size_t i) {
      progress.throw_if_cancelled();
      tallies[i] = decide(i);
      const std::size_t now = ++done;
      if (now % 64 == 0 || now == count) progress.report("sight lines", static_cast<double>(now) / count);
    });
    for (const Tally& tally : tallies) {
      result_.cells.visible += tally.cells.visible;
      result_.cells.hidden += tally.cells.hidden;
      result_.cells.outside += tally.cells.outside;
      result_.statistics.rays += tally.rays;
      result_.error_bound_m = std::max(result_.error_bound_m, scene_.error_bound(tally.longest));
    }
  }

 private:
  struct Tally {
    CellCounts cells;
    std::uint64_t rays = 0;
    double longest = 0;  ///< metres
  };

  /// What is known of a tile's cells so far.
  struct TileState {
    TileState(const Grid& units, const RasterGrid& grid, const Tile& t) : tile(t), centres(units, grid, t) {}
    Tile tile;
    TileCentres centres;
    TileValues<double> heights;
    TileValues<std::uint16_t> seen;  ///< by how many observers, or kCountOutside
    Occluder occluder;
    Tally tally;
  };

  Tally decide(std::size_t index) const {
    const auto state = std::make_unique<TileState>(tin_.grid, result_.grid, tile_at(result_.grid, tiles_, index));
    scan_convert(tin_, bins_.triangles(index), state->tile, state->centres, state->heights);
    state->seen.fill(kCountOutside);
    for (const Eye& eye : eyes_) {
      for (std::int64_t r = 0; r < state->tile.rows; r += kPacketSide)
        for (std::int64_t c = 0; c < state->tile.columns; c += kPacketSide) decide_packet(eye, r, c, *state);
    }
    store(*state);
    return state->tally;
  }

  void decide_packet(const Eye& eye, std::int64_t row, std::int64_t column, TileState& state) const {
    SightLines lines;
    lines.from_x.fill(eye.units.x), lines.from_y.fill(eye.units.y), lines.from_z.fill(eye.units.z);
    const double per_metre = 1 / tin_.grid.resolution;
    double longest = 0;
    for (unsigned i = 0; i < SightLines::kSize; ++i) {
      const std::int64_t r = row + i / kPacketSide, c = column + i % kPacketSide;
      const std::size_t cell = cell_of(r, c);
      if (std::isnan(state.heights[cell]) || already_seen(state.seen[cell])) continue;
      const Point2 centre = result_.grid.centre(state.tile.column + c, state.tile.row + r);
      const double ground = state.heights[cell] * tin_.grid.resolution;
      const double target =
          result_.request.target_absolute ? result_.request.target_height : ground + result_.request.target_height;
      const double dx = centre.x - eye.position.x, dy = centre.y - eye.position.y, dz = target - eye.elevation;
      if (!view_.contains(dx, dy, dz)) continue;
      if (state.seen[cell] == kCountOutside) state.seen[cell] = 0;
      lines.to_x[i] = state.centres.x[static_cast<std::size_t>(c)];
      lines.to_y[i] = state.centres.y[static_cast<std::size_t>(r)];
      lines.to_z[i] = target * per_metre;
      if (lines.to_z[i] < state.heights[cell] - grazing_) continue;  // an elevation below the ground
      if (lines.to_x[i] == eye.units.x && lines.to_y[i] == eye.units.y) {
        ++state.seen[cell];
        continue;
      }
      lines.active |= 1U << i;
      longest = std::max(longest, dx * dx + dy * dy + dz * dz);
    }
    if (lines.active == 0) return;
    state.tally.longest = std::max(state.tally.longest, std::sqrt(longest));
    state.tally.rays += static_cast<unsigned>(std::popcount(lines.active));
    const unsigned visible = lines.active & ~scene_.hidden(lines, state.occluder);
    for (unsigned i = 0; i < SightLines::kSize; ++i)
      if ((visible >> i & 1) != 0) ++state.seen[cell_of(row + i / kPacketSide, column + i % kPacketSide)];
  }

  static std::size_t cell_of(std::int64_t row, std::int64_t column) {
    return static_cast<std::size_t>(row * Tile::kSide + column);
  }
  bool already_seen(std::uint16_t seen) const {
    return result_.request.mode == Mode::kVisible && seen != 0 && seen != kCountOutside;
  }

  void store(TileState& state) const {
    const Tile& tile = state.tile;
    for (std::int64_t r = 0; r < tile.rows; ++r) {
      const std::uint16_t* const seen = state.seen.data() + r * Tile::kSide;
      const std::size_t first = result_.grid.index({tile.column, tile.row + r});
      for (std::int64_t c = 0; c < tile.columns; ++c) {
        const bool outside = seen[c] == kCountOutside, visible = !outside && seen[c] > 0;
        ++(outside ? state.tally.cells.outside : visible ? state.tally.cells.visible : state.tally.cells.hidden);
        const std::size_t i = first + static_cast<std::size_t>(c);
        if (result_.request.mode == Mode::kCount) {
          result_.count[i] = seen[c];
        } else {
          result_.visible[i] = outside ? kOutside : visible ? kVisible : kHidden;
        }
      }
    }
  }

  const Tin& tin_;
  const Scene& scene_;
  std::vector<Eye> eyes_;
  const TriangleBins& bins_;
  const RasterGrid& tiles_;
  Result& result_;
  FieldOfView view_;
  double grazing_;
};

void look_for_voids(const Tin& tin, const std::vector<BoundaryEdge>& boundary, Result& result) {
  const double reach = result.request.radius.value_or(std::numeric_limits<double>::infinity());
  for (const Observer& observer : result.request.observers) {
    result.crosses_voids = result.crosses_voids || surface_resumes(tin, boundary, observer.position, reach);
  }
  if (result.crosses_voids && result.request.nodata == NoData::kUnknown) result.warnings.emplace_back(kVoidsWarning);
}

}  // namespace

namespace {

/// `ground` is null where it is the surface itself.
Result compute_on(const Tin& tin, const Tin* ground, const Request& request, Progress& progress) {
  validate(request);
  if (tin.triangles.empty()) eye_of(tin.grid, request.observers.front(), std::nullopt);
  Result result;
  result.request = request;
  Stopwatch watch;
  progress.report("scene", 0);
  const Scene scene(tin, request.earth, request.nodata, ceiling_of(tin, request));
  const Tin* const base = request.observers_on_surface ? nullptr : ground;
  std::vector<Eye> eyes;
  for (const Observer& observer : request.observers) {
    const auto height = base != nullptr ? height_on(*base, observer.position) : scene.ground(observer.position);
    eyes.push_back(eye_of(tin.grid, observer, height));
    result.ground_m.push_back(*height);
  }
  result.grid = cells_of(request, tin.bounds());
  look_for_voids(tin, scene.boundary(), result);
  result.statistics.triangles = tin.triangles.size();
  result.statistics.retrieval = tin.statistics;
  result.statistics.scene_seconds = watch.lap();

  const RasterGrid tiles = grid_of_tiles(result.grid);
  const Tin& targets = ground != nullptr && !request.targets_on_surface ? *ground : tin;
  const TriangleBins bins(targets, tiles);
  if (request.mode == Mode::kCount) {
    result.count.resize(result.grid.cell_count());
  } else {
    result.visible.resize(result.grid.cell_count());
  }
  Caster(targets, scene, std::move(eyes), bins, tiles, result).run(progress);
  result.statistics.rays_seconds = watch.lap();
  return result;
}

}  // namespace

Result compute(const Tin& tin, const Request& request, Progress& progress) {
  return compute_on(tin, nullptr, request, progress);
}

Result compute(const Tin& tin, const Tin& ground, const Request& request, Progress& progress) {
  return compute_on(tin, &ground, request, progress);
}

}  // namespace itin::viewshed
