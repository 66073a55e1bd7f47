#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include <itin/level_choice.hpp>
#include <viewshed/plan.hpp>
#include <viewshed/surface.hpp>

#include "line/cell_tiles.hpp"
#include "line/infinity.hpp"
#include "plan/certified_way.hpp"
#include "plan/memory.hpp"
#include "plan/partition.hpp"
#include "plan/plan_id.hpp"
#include "plan/point_counts.hpp"
#include "plan/tile_halves.hpp"
#include "request/request.hpp"
#include "request/request_window.hpp"

namespace itin::viewshed {

namespace {

/// Counts points of the surface that the request asks for: the points of its coarsest level, and within each ring also
/// the points of the ring's level.
class SurfacePoints {
 public:
  SurfacePoints(const Store& store, const Request& request)
      : store_(store),
        detail_(request.detail),
        coarsest_(store, level_within(store.metadata(), request.detail.coarsest()), box_of_window(store, request)) {}

  std::uint64_t within(const Window& window) const {
    std::uint64_t points = coarsest_.within(window);
    for (std::size_t i = 0; i + 1 < detail_.rings().size(); ++i) {
      const Ring& ring = detail_.rings()[i];
      const Box box = intersection(square_about(detail_.centre(), ring.radius), window.bounds());
      if (!box.empty()) points += store_.points_about(level_within(store_.metadata(), ring.tolerance), box);
    }
    return points;
  }

 private:
  const Store& store_;
  const Detail& detail_;
  PointCounts coarsest_;
};

/// Returns the request for some of its observers on a part of the cells.
Request request_on(const Request& whole, const RasterGrid& grid, const Segment& segment) {
  Request request = whole;
  request.observers.clear();
  for (const std::uint32_t number : segment.observers) request.observers.push_back(whole.observers[number]);
  request.cell_size.reset();
  request.grid = grid.part(segment.north_west, segment.columns, segment.rows);
  return request;
}

std::vector<std::uint32_t> all_observers(const Request& request) {
  std::vector<std::uint32_t> all(request.observers.size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

/// Returns a segment of every cell for every observer.
Segment whole_of(const Request& request, const RasterGrid& grid) {
  return {{0, 0}, grid.columns(), grid.rows(), all_observers(request), 0, 0};
}

class Division {
 public:
  Division(const Store& store, const Request& request, const ComputeOptions& options, const RasterGrid& grid,
           std::uint64_t most_cells)
      : store_(store),
        request_(request),
        grid_(grid),
        memory_(options.memory_bytes),
        bytes_per_point_(options.lattices && takes_a_lattice(store, request) ? kBytesPerPost
                                                                             : bytes_per_point(request)),
        most_cells_(most_cells),
        points_(store, request) {}

  std::vector<Segment> run() {
    segments_ = parts_that_fit(
        whole_of(request_, grid_), [&](Segment& segment) { return fits_or_is_tile(segment); }, halves_of);
    std::erase_if(segments_, [](const Segment& segment) { return segment.observers.empty(); });
    std::sort(segments_.begin(), segments_.end(), [](const Segment& a, const Segment& b) {
      return std::tie(a.distance_m, a.north_west.row, a.north_west.column) <
             std::tie(b.distance_m, b.north_west.row, b.north_west.column);
    });
    place_the_rest();
    return std::move(segments_);
  }

 private:
  /// Takes a tile even where it does not fit: it is read piece by piece.
  bool fits_or_is_tile(Segment& segment) const {
    leave_those_that_reach(segment);
    const bool tile = segment.columns <= Tile::kSide && segment.rows <= Tile::kSide;
    return segment.observers.empty() || fits(segment) || tile;
  }

  void leave_those_that_reach(Segment& segment) const {
    const Box box = grid_.part(segment.north_west, segment.columns, segment.rows).bounds();
    double nearest = kInfinity;
    std::erase_if(segment.observers, [&](std::uint32_t number) {
      const Observer& observer = request_.observers[number];
      const double squared = squared_distance(observer.position, box);
      const std::optional<double> radius = radius_of(request_, observer);
      if (radius && squared > *radius * *radius) return true;
      nearest = std::min(nearest, squared);
      return false;
    });
    segment.distance_m = std::sqrt(nearest);
  }

  bool fits(Segment& segment) const {
    const Request request = request_on(request_, grid_, segment);
    segment.points = points_.within(window_of(request));
    return request.grid->cell_count() <= most_cells_ && holds_rasters(memory_, store_, request) &&
           segment.points <= memory_beside_rasters(memory_, store_, request) / bytes_per_point_;
  }

  /// Halves a segment between tiles; both halves have its observers.
  static std::pair<Segment, Segment> halves_of(const Segment& whole) {
    const CellRectangle cells{whole.north_west.column, whole.north_west.row, whole.columns, whole.rows};
    const auto [first, rest] = halves_between_tiles(cells);
    const auto segment = [&](const CellRectangle& c) {
      return Segment{{c.column, c.row}, c.columns, c.rows, whole.observers, 0, 0};
    };
    return {segment(first), segment(rest)};
  }

  /// Gives observers that reach no cell to the first segment, so that they are looked for on the ground as all are.
  void place_the_rest() {
    std::vector<bool> placed(request_.observers.size());
    for (const Segment& segment : segments_)
      for (const std::uint32_t number : segment.observers) placed[number] = true;
    if (segments_.empty()) {
      segments_.push_back(
          {{0, 0}, std::min(grid_.columns(), Tile::kSide), std::min(grid_.rows(), Tile::kSide), {}, 0, 0});
      fits(segments_.front());
    }
    std::vector<std::uint32_t>& first = segments_.front().observers;
    for (std::uint32_t number = 0; number < placed.size(); ++number)
      if (!placed[number]) first.push_back(number);
    std::sort(first.begin(), first.end());
  }

  const Store& store_;
  const Request& request_;
  const RasterGrid& grid_;
  std::uint64_t memory_, bytes_per_point_, most_cells_;
  SurfacePoints points_;
  std::vector<Segment> segments_;
};

RasterGrid checked_cells(const Store& store, const Request& request, Certainty certainty) {
  certainty == Certainty::kCertified ? validate_certified(request) : validate(request);
  return cells_of(request, extent_of(store));
}

/// The request whose surface is read where segments are decided exactly.
Request exact_request(const Request& request, Certainty certainty) {
  Request exact = request;
  if (certainty == Certainty::kCertified) exact.detail = Detail::tolerance(0);
  return exact;
}

}  // namespace

Plan::Plan(const Store& store, const Request& request, const ComputeOptions& options, std::uint64_t most_cells,
           Certainty certainty)
    : request_(request),
      options_(options),
      certainty_(certainty),
      exactly_(certainty == Certainty::kExact || certified_way(store, request) == CertifiedWay::kExactly),
      grid_(checked_cells(store, request, certainty)),
      segments_(exactly_ ? Division(store, exact_request(request, certainty), options, grid_, most_cells).run()
                         : std::vector{whole_of(request, grid_)}),
      id_(id_of(store.metadata(), *this)) {}

Request Plan::request_of(std::size_t segment) const {
  return request_on(request_, grid_, segments_.at(segment));
}

}  // namespace itin::viewshed
