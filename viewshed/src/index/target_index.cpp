#include "index/target_index.hpp"

#include <atomic>
#include <cmath>
#include <optional>
#include <utility>

#include <viewshed/surface.hpp>

#include "index/index_plan.hpp"
#include "index/line_tester.hpp"
#include "index/visibility_sampler.hpp"
#include "plan/memory.hpp"
#include "progress/stage.hpp"
#include "run/segments.hpp"
#include "run/surface_reader.hpp"

namespace itin::viewshed {

namespace {

/// The standard error of the share seen among targets on ground, with one more of either kind, so that none or all seen
/// is no certainty.
double standard_error(const VisibilitySampler::Tally& tally) {
  const double n = tally.on_ground + 2, p = (tally.seen + 1) / n;
  return std::sqrt(p * (1 - p) / n);
}

/// Samples a part of an index, segment by segment.
class TargetIndexWork {
 public:
  TargetIndexWork(const Store& store, const IndexRequest& request, const IndexLayout& layout,
                  const CellRectangle& cells)
      : store_(store),
        request_(request),
        grid_(layout.grid),
        targets_(layout.sample.targets),
        has_raised_(request.themes.includes_raised(store.metadata().themes)),
        reader_(store, request.detail, read_),
        memory_(memory_beside(kBytesPerIndexCell * cells.count(), request.memory_bytes)),
        part_(cells) {}

  /// Plans for posts first: where all ground under a segment is posts of a lattice, there is room for far more of them.
  IndexPart run(Progress& progress) {
    const auto posts_fit = [&](const IndexSegment& segment) { return segment.points <= memory_ / kBytesPerPost; };
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
    part_.counts.targets = asked_, part_.counts.lines = lines_;
    part_.counts.triangles = read_.triangles, part_.counts.retrieval = read_.retrieval;
    return std::move(part_);
  }

 private:
  std::vector<IndexSegment> plan(const CellRectangle& cells, const SurfaceFits& fits) const {
    return index_segments(store_, request_, grid_, cells, fits);
  }

  std::uint64_t lines_of(const IndexSegment& segment) const { return segment.cells.count() * targets_; }

  void sample_triangles(const CellRectangle& cells, Progress& progress) {
    const auto fit = [&](const IndexSegment& segment) {
      const std::uint64_t ground = has_raised_ ? LineTester::bytes(segment.points, 0) : 0;
      return LineTester::bytes(segment.points, lines_of(segment)) + ground <= memory_;
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
                                    {request_.radius, request_.target_height, targets_}, request_.nodata);
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
    asked_ += tally.asked;
    lines_ += tally.on_ground;
    if (tally.on_ground == 0) return;
    const std::size_t i = part_.number(cell);
    const auto all = static_cast<float>(tally.on_ground);
    part_.shares.share[i] = static_cast<float>(tally.seen) / all;
    part_.shares.undecided[i] = static_cast<float>(tally.undecided) / all;
    part_.shares.standard_error[i] = static_cast<float>(standard_error(tally));
  }

  const Store& store_;
  const IndexRequest& request_;
  const RasterGrid& grid_;
  unsigned targets_;  ///< for each observer
  bool has_raised_;   ///< whether the request names raised themes
  Statistics read_;
  SurfaceReader reader_;
  std::uint64_t memory_;  ///< bytes, without the rasters
  IndexPart part_;
  std::atomic<bool> any_eye_ = false;
  std::atomic<std::uint64_t> asked_ = 0, lines_ = 0;
};

}  // namespace

IndexPart index_part_by_targets(const Store& store, const IndexRequest& request, const IndexLayout& layout,
                                const CellRectangle& cells, Progress& progress) {
  return TargetIndexWork(store, request, layout, cells).run(progress);
}

}  // namespace itin::viewshed
