#include "index/ray_index.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <itin/grazing.hpp>
#include <itin/precondition.hpp>

#include "index/index_plan.hpp"
#include "index/post_rows.hpp"
#include "index/ray_course.hpp"
#include "index/ray_sums.hpp"
#include "plan/memory.hpp"
#include "progress/stage.hpp"
#include "run/segments.hpp"

namespace itin::viewshed {

namespace {

constexpr auto kTogether = static_cast<std::int64_t>(PostRows::kTogether);
/// What a post under a segment takes: in the lattice, and laid out in rows.
constexpr std::uint64_t kBytesPerPostOfRays = 10;

/// An observer, and what is seen from it as rays are walked.
struct RayObserver {
  std::optional<double> ground = {};  ///< height, grid units; nothing where nobody stands
  RaySums sums = {};
  double beyond = 0;  ///< what looks count that ground without data alone could hide
};

/// Observers that a thread looks from.
struct RayTile {
  CellRectangle cells;
  std::int64_t first_column = 0;  ///< the column of cells whose observers have number 0 among the posts
  const PostRows& posts;
  const RayFan& fan;
  std::vector<RayObserver> observers;  ///< row by row
  IndexCounts counts;
};

/// Divides cells into tiles, each of which takes a thread long enough to be worth the courses of its rays.
std::vector<CellRectangle> tiles_of_observers(const CellRectangle& cells) {
  constexpr std::int64_t kColumns = 4 * kTogether, kRows = 32;
  std::vector<CellRectangle> tiles;
  for (std::int64_t row = 0; row < cells.rows; row += kRows)
    for (std::int64_t column = 0; column < cells.columns; column += kColumns)
      tiles.push_back({cells.column + column, cells.row + row, std::min(kColumns, cells.columns - column),
                       std::min(kRows, cells.rows - row)});
  return tiles;
}

/// Returns the numbers of a lattice's tiles that have posts of a box.
std::vector<std::uint32_t> tiles_with_posts(const LatticeTin& lattice, const PostBox& box) {
  constexpr std::int64_t kSide = LatticeTin::kSide;
  const auto first = [](std::int64_t place) { return std::max<std::int64_t>(place - 1, 0) / kSide; };
  const auto last = [](std::int64_t place, std::uint32_t count) {
    return std::min(place / kSide, std::int64_t{count} - 1);
  };
  std::vector<std::uint32_t> tiles;
  for (std::int64_t row = first(box.north); row <= last(box.south, lattice.tile_rows()); ++row)
    for (std::int64_t column = first(box.west); column <= last(box.east, lattice.tile_columns()); ++column)
      tiles.push_back(static_cast<std::uint32_t>(row * lattice.tile_columns() + column));
  return tiles;
}

/// Looks from some cells along rays, segment by segment.
class RayIndexWork {
 public:
  RayIndexWork(const Store& store, const IndexRequest& request, const IndexLayout& layout, const CellRectangle& cells,
               Instructions instructions)
      : store_(store),
        request_(request),
        layout_(layout),
        instructions_(instructions),
        memory_(memory_beside(kBytesPerIndexCell * cells.count(), request.memory_bytes)),
        part_(cells) {
    part_.counts.make_rays(layout.sample.rays);
  }

  IndexPart run(Progress& progress) {
    open(progress);
    part_.counts.retrieval = lattice().statistics;
    const auto fit = [&](const IndexSegment& segment) {
      return posts_under(segment.cells).count() * kBytesPerPostOfRays <= memory_;
    };
    const auto effort = [&](const IndexSegment& segment) {
      const double looks = static_cast<double>(segment.cells.count()) * layout_.sample.rays * layout_.rings;
      return Effort{effort_of_posts(posts_under(segment.cells).count()), effort_of_looks(looks)};
    };
    bool fresh = true;
    for_each_segment(index_segments(store_, request_, layout_.grid, part_.cells, fit), effort, progress,
                     [&](const IndexSegment& segment, SegmentProgress& of_segment) {
                       // A reader keeps all that it has read.
                       if (!std::exchange(fresh, false)) open(progress);
                       look(segment.cells, of_segment);
                     });
    return std::move(part_);
  }

 private:
  const LatticeTin& lattice() const { return reader_->lattice(); }

  void open(Progress& progress) {
    reader_.reset();
    reader_ = posts_under_index(store_, request_, layout_.grid, progress);
    ITIN_PRECONDITION(reader_ != nullptr);
    among_ = observers_among_posts(layout_.grid, lattice()).value();
  }

  std::int64_t column_of(std::int64_t cell_column) const { return among_.column + cell_column * among_.step; }
  std::int64_t row_of(std::int64_t cell_row) const { return among_.row + cell_row * among_.step; }

  /// Returns the posts at the observers of some cells, or to the north-west of them.
  PostBox posts_of(const CellRectangle& cells) const {
    return {column_of(cells.column), row_of(cells.row), column_of(cells.column + cells.columns - 1),
            row_of(cells.row + cells.rows - 1)};
  }

  /// Returns how far the rays from some cells may meet ground, grid units.
  double reach_of(const CellRectangle& cells) const {
    const LatticeTin& posts = lattice();
    const GridBox& data = store_.metadata().bounds;
    const auto x = [&](std::int64_t c) {
      return posts.west + (static_cast<double>(column_of(c)) + among_.east) * posts.spacing;
    };
    const auto y = [&](std::int64_t r) {
      return posts.north - (static_cast<double>(row_of(r)) + among_.south) * posts.spacing;
    };
    const double across = std::max(data.xmax - x(cells.column), x(cells.column + cells.columns - 1) - data.xmin),
                 down = std::max(y(cells.row) - data.ymin, data.ymax - y(cells.row + cells.rows - 1));
    return std::min(request_.radius / posts.grid.resolution, std::hypot(across, down) + posts.spacing);
  }

  /// Returns the posts under the rays from some cells.
  PostBox posts_under(const CellRectangle& cells) const {
    // A ray ends at an edge of the cell of posts in which it looks last.
    const auto reach = static_cast<std::int64_t>(std::ceil(reach_of(cells) / lattice().spacing)) + 2;
    return posts_of(cells).around({-reach, -reach, reach, reach});
  }

  void look(const CellRectangle& cells, SegmentProgress& progress) {
    const PostBox box = posts_under(cells);
    reader_->read(tiles_with_posts(lattice(), box), progress.reading());
    const PostRows posts(lattice(), box, column_of(cells.column), among_.step);
    part_.counts.triangles += posts.triangle_count();
    const double resolution = lattice().grid.resolution;
    const RayFan fan{.east = among_.east,
                     .south = among_.south,
                     .spacing = static_cast<double>(lattice().spacing),
                     .radius = request_.radius / resolution,
                     .rings = layout_.rings,
                     .reach = reach_of(cells),
                     .target_height = request_.target_height / resolution,
                     .drop = request_.earth.drop_coefficient() * resolution,
                     .grazing = kGrazing / resolution};
    const std::vector<CellRectangle> tiles = tiles_of_observers(cells);
    Progress& judging = progress.judging();
    for_each_step(tiles.size(), "observers", judging, [&](std::size_t i) {
      RayTile tile{tiles[i], cells.column, posts, fan, std::vector<RayObserver>(tiles[i].count()), {}};
      if (!stand(tile)) return;
      tile.counts.make_rays(layout_.sample.rays);
      for (unsigned ray = 0; ray < layout_.sample.rays; ++ray) {
        judging.throw_if_cancelled();
        walk(ray, tile);
      }
      take(tile);
    });
  }

  std::ptrdiff_t place_of(const RayTile& tile, RasterGrid::Cell cell) const {
    return tile.posts.place(cell.column - tile.first_column, row_of(cell.row));
  }

  /// Puts the observers on their ground. Returns false where nobody stands.
  bool stand(RayTile& tile) const {
    for (std::size_t i = 0; i < tile.observers.size(); ++i) {
      const RasterGrid::Cell cell = tile.cells.cell(i);
      if (request_.area.contains(layout_.grid.centre(cell.column, cell.row)))
        tile.observers[i].ground = tile.posts.ground(place_of(tile, cell), among_.east, among_.south);
    }
    return std::any_of(tile.observers.begin(), tile.observers.end(),
                       [](const RayObserver& observer) { return observer.ground.has_value(); });
  }

  /// Walks one ray from all observers of a tile.
  void walk(unsigned ray, RayTile& tile) const {
    const CellRectangle& cells = tile.cells;
    const RayCourse course(tile.fan, azimuth_of_ray(ray, layout_.sample.rays), tile.posts, posts_of(cells));
    for (std::int64_t row = 0; row < cells.rows; ++row) {
      for (std::int64_t column = 0; column < cells.columns; column += kTogether) {
        const auto first = static_cast<std::size_t>(row * cells.columns + column),
                   count = static_cast<std::size_t>(std::min(kTogether, cells.columns - column));
        RayWalk walk{.place = place_of(tile, {cells.column + column, cells.row + row})};
        const std::span<RayObserver> observers = std::span(tile.observers).subspan(first, count);
        for (std::size_t i = 0; i < count; ++i) {
          walk.there[i] = observers[i].ground.has_value();
          walk.ground[i] = observers[i].ground.value_or(0);
          walk.eye[i] = walk.ground[i] + request_.height / lattice().grid.resolution;
        }
        walk_ray(course, tile.posts, instructions_, walk);
        add(walk, ray, observers, tile.counts);
      }
    }
  }

  void add(const RayWalk& walk, unsigned ray, std::span<RayObserver> observers, IndexCounts& counts) const {
    for (std::size_t i = 0; i < observers.size(); ++i) {
      if (!observers[i].ground) continue;
      const double seen = walk.seen[i] + (request_.nodata == NoData::kClear ? walk.beyond[i] : 0);
      observers[i].sums.add(walk.on_ground[i], seen);
      observers[i].beyond += walk.beyond[i];
      counts.lines += static_cast<std::uint64_t>(walk.looks[i]);
      counts.on_ground_of_ray[ray] += static_cast<std::uint64_t>(walk.on_ground[i]);
      counts.seen_of_ray[ray] += static_cast<std::uint64_t>(seen);
    }
  }

  /// Takes what the observers of a tile see.
  void take(RayTile& tile) {
    const double of_looks = RaySums::variance_of_looks(layout_.sample.rays, layout_.rings);
    for (std::size_t i = 0; i < tile.observers.size(); ++i) {
      const RayObserver& observer = tile.observers[i];
      if (!observer.ground) continue;
      tile.counts.any_eye = true;
      tile.counts.targets += std::uint64_t{layout_.sample.rays} * layout_.rings;
      const double all = observer.sums.on_ground();
      if (all == 0) continue;
      const std::size_t cell = part_.number(tile.cells.cell(i));
      part_.shares.share[cell] = static_cast<float>(observer.sums.share());
      part_.shares.standard_error[cell] = static_cast<float>(observer.sums.standard_error(of_looks));
      part_.shares.undecided[cell] =
          request_.nodata == NoData::kUnknown ? static_cast<float>(observer.beyond / all) : 0.0F;
    }
    const std::lock_guard lock(mutex_);
    part_.counts += tile.counts;
  }

  const Store& store_;
  const IndexRequest& request_;
  const IndexLayout& layout_;
  Instructions instructions_;
  std::uint64_t memory_;  ///< bytes, without the rasters
  std::unique_ptr<LatticeReader> reader_;
  ObserverPosts among_;
  std::mutex mutex_;
  IndexPart part_;  ///< the mutex guards its counts
};

}  // namespace

double azimuth_of_ray(unsigned ray, unsigned rays) {
  constexpr double kPhase = 0.6180339887498949;  // no multiple of an eighth of a turn comes of it
  return 2 * std::numbers::pi * (ray + kPhase) / rays;
}

IndexPart index_part_by_rays(const Store& store, const IndexRequest& request, const IndexLayout& layout,
                             const CellRectangle& cells, Progress& progress, Instructions instructions) {
  return RayIndexWork(store, request, layout, cells, instructions).run(progress);
}

}  // namespace itin::viewshed
