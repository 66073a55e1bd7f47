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

#include "index/index_plan.hpp"
#include "index/line_tester.hpp"
#include "index/visibility_sampler.hpp"
#include "plan/memory.hpp"
#include "progress/stage.hpp"
#include "run/segments.hpp"
#include "run/surface_reader.hpp"

namespace itin::viewshed {

namespace {

constexpr float kNoShare = std::numeric_limits<float>::quiet_NaN();

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

/// Samples an index segment by segment.
class IndexWork {
 public:
  IndexWork(const Store& store, const IndexRequest& request)
      : store_(store),
        request_(request),
        has_raised_(request.themes.includes_raised(store.metadata().themes)),
        reader_(store, request.detail, read_) {
    index_.grid =
        RasterGrid::aligned(request.area.is_all() ? extent_of(store) : request.area.bounds(), request.cell_size);
    const std::uint64_t bytes = kBytesPerCell * index_.grid.cell_count();
    require_memory_for_rasters(index_.grid, bytes, request.memory_bytes);
    memory_ = memory_beside(bytes, request.memory_bytes);
    index_.share.assign(index_.grid.cell_count(), kNoShare);
    index_.standard_error.assign(index_.grid.cell_count(), kNoShare);
    index_.undecided.assign(index_.grid.cell_count(), kNoShare);
  }

  /// Plans for posts first: where all ground under a segment is posts of a lattice, there is room for far more of them.
  VisibilityIndex run(Progress& progress) {
    const auto posts_fit = [&](std::uint64_t points, std::uint64_t) { return points <= memory_ / kBytesPerPost; };
    const auto effort = [&](const IndexSegment& s) {
      return Effort{effort_of_posts(s.points), effort_of_lines(static_cast<double>(lines_of(s)))};
    };
    for_each_segment(
        plan(all_cells(index_.grid), posts_fit), effort, progress,
        [&](const IndexSegment& segment, SegmentProgress& of_segment) {
          if (const auto lattice = reader_.lattice(segment.window, request_.themes, kAnyLattice, of_segment.reading()))
            sample(segment, *lattice, std::nullopt, of_segment);
          else
            sample_triangles(segment.cells, of_segment.judging());
        });
    summarise();
    return std::move(index_);
  }

 private:
  std::vector<IndexSegment> plan(const CellRectangle& cells, const SurfaceFits& fits) const {
    return index_segments(store_, request_, index_.grid, cells, fits);
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
    const Point2 place = index_.grid.centre(cell.column, cell.row);
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
    const std::size_t i = index_.grid.index(cell);
    const auto all = static_cast<float>(tally.on_ground);
    index_.share[i] = static_cast<float>(tally.seen) / all;
    index_.undecided[i] = static_cast<float>(tally.undecided) / all;
    index_.standard_error[i] = static_cast<float>(standard_error(tally));
  }

  void summarise() {
    index_.retrieval = read_.retrieval;
    index_.triangles = read_.triangles;
    if (index_.triangles == 0) throw InputError("the area holds no ground", "area");
    if (!any_eye_) throw InputError("no cell's centre lies on ground in the area; give smaller cells", "cell_size");
    double variance = 0;
    for (std::size_t i = 0; i < index_.share.size(); ++i) {
      if (std::isnan(index_.share[i])) continue;
      ++index_.observers;
      index_.mean += index_.share[i];
      index_.mean_undecided += index_.undecided[i];
      variance += double{index_.standard_error[i]} * index_.standard_error[i];
    }
    if (index_.observers == 0)
      throw InputError(
          "no target fell on ground: the radius reaches far beyond it; give a smaller one, or more targets", "radius");
    index_.targets = targets_;
    index_.lines = lines_;
    index_.mean /= static_cast<double>(index_.observers);
    index_.mean_undecided /= static_cast<double>(index_.observers);
    index_.mean_error = std::sqrt(variance) / static_cast<double>(index_.observers);
  }

  static constexpr std::uint64_t kBytesPerCell = 24;

  const Store& store_;
  const IndexRequest& request_;
  bool has_raised_;  ///< whether the request names raised themes
  Statistics read_;
  SurfaceReader reader_;
  std::uint64_t memory_ = 0;  ///< bytes, without the rasters
  VisibilityIndex index_;
  std::atomic<bool> any_eye_ = false;
  std::atomic<std::uint64_t> targets_ = 0, lines_ = 0;
};

}  // namespace

VisibilityIndex visibility_index(const Store& store, const IndexRequest& request, Progress& progress) {
  require_valid_index(request);
  return IndexWork(store, request).run(progress);
}

}  // namespace itin::viewshed
