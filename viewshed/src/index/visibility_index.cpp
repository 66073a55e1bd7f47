#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <itin/error.hpp>
#include <viewshed/surface.hpp>
#include <viewshed/visibility_index.hpp>

#include "index/index_part.hpp"
#include "index/index_plan.hpp"
#include "index/line_tester.hpp"
#include "index/visibility_sampler.hpp"
#include "plan/memory.hpp"
#include "progress/stage.hpp"
#include "run/segments.hpp"
#include "run/surface_reader.hpp"

namespace itin::viewshed {

namespace {

constexpr std::uint64_t kBytesPerCell = 24;

IndexShares no_shares(std::size_t cells) {
  const std::vector<float> none(cells, std::numeric_limits<float>::quiet_NaN());
  return {none, none, none};
}

void require_valid_index(const IndexRequest& request) {
  const auto require = [](bool holds, const char* field, const char* what) {
    if (!holds) throw InputError(what, field);
  };
  require(std::isfinite(request.cell_size) && request.cell_size > 0, "cell_size",
          "the cell size must be positive, in metres");
  require(std::isfinite(request.radius) && request.radius > 0, "radius", "the radius must be positive, in metres");
  require(request.height >= 0, "height", "heights above the ground must not be negative");
  require(request.target_height >= 0, "target_height", "heights above the ground must not be negative");
  require(request.targets > 0, "targets", "give at least one target for each observer");
}

/// The standard error of the share seen among targets on ground, with one more of either kind, so that none or all seen
/// is no certainty.
double standard_error(const VisibilitySampler::Tally& tally) {
  const double n = tally.on_ground + 2, p = (tally.seen + 1) / n;
  return std::sqrt(p * (1 - p) / n);
}

/// Samples a part of an index, segment by segment.
class IndexWork {
 public:
  IndexWork(const Store& store, const IndexRequest& request, const RasterGrid& grid, const CellRectangle& cells)
      : store_(store),
        request_(request),
        grid_(grid),
        has_raised_(request.themes.includes_raised(store.metadata().themes)),
        reader_(store, request.detail, read_),
        memory_(memory_beside(kBytesPerCell * cells.count(), request.memory_bytes)),
        part_{cells, no_shares(cells.count())} {}

  /// Plans for posts first: where all ground under a segment is posts of a lattice, there is room for far more of them.
  IndexPart run(Progress& progress) {
    const auto posts_fit = [&](std::uint64_t points, std::uint64_t) { return points <= memory_ / kBytesPerPost; };
    const auto effort = [&](const IndexSegment& s) {
      return Effort{effort_of_posts(s.points), effort_of_lines(static_cast<double>(lines_of(s)))};
    };
    for_each_segment(
        plan(part_.cells, posts_fit), effort, progress, [&](const IndexSegment& segment, SegmentProgress& of_segment) {
          if (const auto lattice = reader_.lattice(segment.window, request_.themes, kAnyLattice, of_segment.reading()))
            sample(segment, *lattice, std::nullopt, of_segment);
          else
            sample_triangles(segment.cells, of_segment.judging());
        });
    part_.counts.any_eye = any_eye_;
    part_.counts.targets = targets_, part_.counts.lines = lines_;
    part_.counts.triangles = read_.triangles, part_.counts.retrieval = read_.retrieval;
    return std::move(part_);
  }

 private:
  std::vector<IndexSegment> plan(const CellRectangle& cells, const SurfaceFits& fits) const {
    return index_segments(store_, request_, grid_, cells, fits);
  }

  std::uint64_t lines_of(const IndexSegment& segment) const { return segment.cells.count() * request_.targets; }

  void sample_triangles(const CellRectangle& cells, Progress& progress) {
    const auto fit = [&](std::uint64_t points, std::uint64_t lines) {
      const std::uint64_t ground = has_raised_ ? LineTester::bytes(points, 0) : 0;
      return LineTester::bytes(points, lines) + ground <= memory_;
    };
    const auto effort = [&](const IndexSegment& s) {
      return Effort{(has_raised_ ? 2 : 1) * effort_of_triangles(s.points),
                    effort_of_lines(static_cast<double>(lines_of(s)))};
    };
    for_each_segment(plan(cells, fit), effort, progress, [&](const IndexSegment& part, SegmentProgress& of_part) {
      const auto triangulated = [&](const ThemeChoice& themes, double share) {
        return RetrievedSurface{reader_.triangles(part.window, themes, of_part.reading(share)), nullptr, {}};
      };
      const RetrievedSurface surface = triangulated(request_.themes, has_raised_ ? 0.5 : 1);
      std::optional<RetrievedSurface> bare;
      if (has_raised_) bare = triangulated(ThemeChoice::none(), 1);
      sample(part, surface, bare, of_part);
    });
  }

  /// Targets and eyes stand on the bare ground where that is another surface.
  void sample(const IndexSegment& segment, const RetrievedSurface& retrieved,
              const std::optional<RetrievedSurface>& bare, SegmentProgress& progress) {
    if (retrieved.triangle_count() == 0) return;
    const LineTester surface(retrieved, request_.earth, lines_of(segment));
    std::optional<LineTester> ground;
    if (bare) ground.emplace(*bare, request_.earth, 0);
    const VisibilitySampler sampler(surface, ground ? *ground : surface,
                                    {request_.radius, request_.target_height, request_.targets}, request_.nodata);
    for_each_step(segment.cells.count(), "observers", progress.judging(),
                  [&](std::size_t i) { sample(sampler, segment.cells.cell(i)); });
  }

  void sample(const VisibilitySampler& sampler, RasterGrid::Cell cell) {
    const Point2 place = grid_.centre(cell.column, cell.row);
    const auto height = request_.area.contains(place) ? sampler.ground(place) : std::nullopt;
    if (!height) return;
    any_eye_ = true;
    const GridPoint seed = store_.metadata().grid.quantise({place.x, place.y, 0});
    const VisibilitySampler::Tally tally =
        sampler.observe(place, *height + request_.height,
                        std::uint64_t{static_cast<std::uint32_t>(seed.x)} << 32 | static_cast<std::uint32_t>(seed.y));
    targets_ += tally.asked;
    lines_ += tally.on_ground;
    if (tally.on_ground == 0) return;
    const auto i =
        static_cast<std::size_t>((cell.row - part_.cells.row) * part_.cells.columns + cell.column - part_.cells.column);
    const auto all = static_cast<float>(tally.on_ground);
    part_.shares.share[i] = static_cast<float>(tally.seen) / all;
    part_.shares.undecided[i] = static_cast<float>(tally.undecided) / all;
    part_.shares.standard_error[i] = static_cast<float>(standard_error(tally));
  }

  const Store& store_;
  const IndexRequest& request_;
  const RasterGrid& grid_;
  bool has_raised_;  ///< whether the request names raised themes
  Statistics read_;
  SurfaceReader reader_;
  std::uint64_t memory_;  ///< bytes, without the rasters
  IndexPart part_;
  std::atomic<bool> any_eye_ = false;
  std::atomic<std::uint64_t> targets_ = 0, lines_ = 0;
};

}  // namespace

RasterGrid index_grid(const Store& store, const IndexRequest& request) {
  require_valid_index(request);
  const RasterGrid grid =
      RasterGrid::aligned(request.area.is_all() ? extent_of(store) : request.area.bounds(), request.cell_size);
  require_memory_for_rasters(grid, kBytesPerCell * grid.cell_count(), request.memory_bytes);
  return grid;
}

IndexPart index_part(const Store& store, const IndexRequest& request, const RasterGrid& grid,
                     const CellRectangle& cells, Progress& progress) {
  return IndexWork(store, request, grid, cells).run(progress);
}

IndexMerge::IndexMerge(const RasterGrid& grid) : grid_(grid), shares_(no_shares(grid.cell_count())) {}

void IndexMerge::add(const IndexPart& part) {
  const auto copy = [&](const std::vector<float>& from, std::vector<float>& to) {
    for (std::size_t i = 0; i < from.size(); ++i) to[grid_.index(part.cells.cell(i))] = from[i];
  };
  copy(part.shares.share, shares_.share);
  copy(part.shares.standard_error, shares_.standard_error);
  copy(part.shares.undecided, shares_.undecided);
  counts_.any_eye = counts_.any_eye || part.counts.any_eye;
  counts_.targets += part.counts.targets, counts_.lines += part.counts.lines;
  counts_.triangles += part.counts.triangles, counts_.retrieval += part.counts.retrieval;
}

VisibilityIndex IndexMerge::take() {
  if (counts_.triangles == 0) throw InputError("the area holds no ground", "area");
  if (!counts_.any_eye)
    throw InputError("no cell's centre lies on ground in the area; give smaller cells", "cell_size");
  VisibilityIndex index;
  index.grid = grid_;
  index.share = std::move(shares_.share), index.standard_error = std::move(shares_.standard_error);
  index.undecided = std::move(shares_.undecided);
  index.targets = counts_.targets, index.lines = counts_.lines;
  index.triangles = counts_.triangles, index.retrieval = counts_.retrieval;
  double variance = 0;
  for (std::size_t i = 0; i < index.share.size(); ++i) {
    if (std::isnan(index.share[i])) continue;
    ++index.observers;
    index.mean += index.share[i];
    index.mean_undecided += index.undecided[i];
    variance += double{index.standard_error[i]} * index.standard_error[i];
  }
  if (index.observers == 0)
    throw InputError("no target fell on ground: the radius reaches far beyond it; give a smaller one, or more targets",
                     "radius");
  const auto observers = static_cast<double>(index.observers);
  index.mean /= observers, index.mean_undecided /= observers;
  index.mean_error = std::sqrt(variance) / observers;
  return index;
}

VisibilityIndex visibility_index(const Store& store, const IndexRequest& request, Progress& progress) {
  const RasterGrid grid = index_grid(store, request);
  IndexMerge merge(grid);
  merge.add(index_part(store, request, grid, all_cells(grid), progress));
  return merge.take();
}

}  // namespace itin::viewshed
