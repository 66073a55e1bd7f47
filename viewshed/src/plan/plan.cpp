#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include <itin/level_choice.hpp>
#include <viewshed/plan.hpp>
#include <viewshed/surface.hpp>

#include "line/cell_tiles.hpp"
#include "plan/certified_way.hpp"
#include "plan/memory.hpp"
#include "plan/plan_id.hpp"
#include "plan/point_counts.hpp"
#include "request/request.hpp"

namespace itin::viewshed {

namespace {

/// Points of the surface that the request asks for, wherever it asks: those of its coarsest level, and within each ring
/// those of its own.
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
      const Box box = intersection(disc_box(detail_.centre(), ring.radius), window.bounds());
      if (!box.empty()) points += store_.points_about(level_within(store_.metadata(), ring.tolerance), box);
    }
    return points;
  }

 private:
  const Store& store_;
  const Detail& detail_;
  PointCounts coarsest_;
};

/// The request for some of its observers on a part of the cells.
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

/// Every cell for every observer.
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
    const std::vector<std::uint32_t> all = all_observers(request_);
    divide(cells({0, 0}, grid_.columns(), grid_.rows()), all);
    std::sort(segments_.begin(), segments_.end(), [](const Segment& a, const Segment& b) {
      return std::tie(a.distance_m, a.north_west.row, a.north_west.column) <
             std::tie(b.distance_m, b.north_west.row, b.north_west.column);
    });
    place_the_rest(all);
    return std::move(segments_);
  }

 private:
  /// That nobody has looked at yet.
  static Segment cells(RasterGrid::Cell north_west, std::int64_t columns, std::int64_t rows) {
    return {north_west, columns, rows, {}, 0, 0};
  }

  void divide(Segment segment, std::span<const std::uint32_t> observers) {
    look_from(segment, observers);
    if (segment.observers.empty()) return;
    const bool tile = segment.columns <= Tile::kSide && segment.rows <= Tile::kSide;
    if (fits(segment) || tile) {
      segments_.push_back(std::move(segment));
      return;
    }
    for (const Segment& half : halves(segment)) divide(half, segment.observers);
  }

  /// Those of the observers that reach the segment.
  void look_from(Segment& segment, std::span<const std::uint32_t> observers) const {
    const Box box = grid_.part(segment.north_west, segment.columns, segment.rows).bounds();
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t number : observers) {
      const Observer& observer = request_.observers[number];
      const double squared = squared_distance(observer.position, box);
      const std::optional<double> radius = radius_of(request_, observer);
      if (radius && squared > *radius * *radius) continue;
      segment.observers.push_back(number);
      nearest = std::min(nearest, squared);
    }
    segment.distance_m = std::sqrt(nearest);
  }

  bool fits(Segment& segment) const {
    const Request request = request_on(request_, grid_, segment);
    segment.points = points_.within(window_of(request));
    return request.grid->cell_count() <= most_cells_ &&
           segment.points <= memory_beside_rasters(memory_, store_, request) / bytes_per_point_;
  }

  /// Across the longer side, between tiles.
  static std::vector<Segment> halves(const Segment& whole) {
    const auto half = [](std::int64_t cells) { return (cells / Tile::kSide + 1) / 2 * Tile::kSide; };
    Segment first = cells(whole.north_west, whole.columns, whole.rows), second = first;
    if (whole.columns >= whole.rows) {
      first.columns = half(whole.columns);
      second.north_west.column += first.columns, second.columns -= first.columns;
    } else {
      first.rows = half(whole.rows);
      second.north_west.row += first.rows, second.rows -= first.rows;
    }
    return {first, second};
  }

  /// Observers that reach no cell are looked for on the ground as all are: the first segment has them.
  void place_the_rest(std::span<const std::uint32_t> all) {
    std::vector<bool> placed(all.size());
    for (const Segment& segment : segments_)
      for (const std::uint32_t number : segment.observers) placed[number] = true;
    if (segments_.empty()) {
      segments_.push_back(cells({0, 0}, std::min(grid_.columns(), Tile::kSide), std::min(grid_.rows(), Tile::kSide)));
      fits(segments_.front());
    }
    std::vector<std::uint32_t>& first = segments_.front().observers;
    std::copy_if(all.begin(), all.end(), std::back_inserter(first),
                 [&](std::uint32_t number) { return !placed[number]; });
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

std::vector<Segment> divided(const Store& store, Request request, const ComputeOptions& options, const RasterGrid& grid,
                             std::uint64_t most_cells, Certainty certainty, bool exactly) {
  if (!exactly) return {whole_of(request, grid)};
  if (certainty == Certainty::kCertified) request.detail = Detail::tolerance(0);
  return Division(store, request, options, grid, most_cells).run();
}

}  // namespace

Plan::Plan(const Store& store, const Request& request, const ComputeOptions& options, std::uint64_t most_cells,
           Certainty certainty)
    : request_(request),
      options_(options),
      certainty_(certainty),
      exactly_(certainty == Certainty::kExact || certified_way(store, request) == CertifiedWay::kExactly),
      grid_(checked_cells(store, request, certainty)),
      segments_(divided(store, request, options, grid_, most_cells, certainty, exactly_)),
      id_(id_of(store.metadata(), *this)) {}

Request Plan::request_of(std::size_t segment) const {
  return request_on(request_, grid_, segments_.at(segment));
}

}  // namespace itin::viewshed
