// The work of a viewshed as a value: segments of its cells, each decided for itself, in any order, by anyone who has
// the store.
//
//   const viewshed::Plan plan(store, request, {.memory_bytes = 256 << 20});
//   viewshed::Merge merge(plan);
//   for (std::size_t i = 0; i < plan.segments().size(); ++i) merge.add(i, viewshed::decide(store, plan, i, progress));
//   const viewshed::Result result = merge.take();
//
// The result is that of compute(), or of compute_certified(), to the last bit. A plan depends on the store, the
// request, the memory and the greatest number of cells of a segment, and on nothing else. Anyone who makes it elsewhere
// from these gets the same segments, so results can be exchanged as files:
//
//   viewshed::write_segment("7.segment", plan, 7, viewshed::decide(store, plan, 7, progress));   // on one machine
//   merge.add(7, viewshed::read_segment("7.segment", plan, 7));                                  // on another
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// A rectangle of cells, and the observers that may see some of them.
struct Segment {
  RasterGrid::Cell north_west;  ///< in Plan::grid()
  std::int64_t columns = 0;
  std::int64_t rows = 0;
  std::vector<std::uint32_t> observers;  ///< their numbers from 0 in the request, ascending
  double distance_m = 0;                 ///< from the nearest of them to the nearest cell
  std::uint64_t points = 0;              ///< points of the surface under the sight lines, about
};

inline constexpr std::uint64_t kAnyNumberOfCells = std::numeric_limits<std::uint64_t>::max();

/// A plan is for the result of compute(), or for that of compute_certified().
enum class Certainty { kExact, kCertified };

class Plan {
 public:
  /// Cuts the request's cells in halves until the surface under the sight lines to a segment fits into the memory, and
  /// the segment has no more than `most_cells` cells. A single tile of 64 by 64 cells need not fit: decide() reads it
  /// piece by piece. A certified viewshed over a coarse level is one segment: cut differently, the level would leave
  /// other cells undecided. Reads the store's directory alone. Throws InputError for a request that is refused whatever
  /// the surface.
  Plan(const Store& store, const Request& request, const ComputeOptions& options = {},
       std::uint64_t most_cells = kAnyNumberOfCells, Certainty certainty = Certainty::kExact);

  const Request& request() const { return request_; }
  const ComputeOptions& options() const { return options_; }
  Certainty certainty() const { return certainty_; }
  /// Whether segments are decided over the full surface or that of the request's detail, not over a coarse level.
  bool decides_exactly() const { return exactly_; }
  /// All cells; the ones that belong to no segment are outside every field of view.
  const RasterGrid& grid() const { return grid_; }
  /// The segments, the nearest to an observer first.
  const std::vector<Segment>& segments() const { return segments_; }
  /// The request that decide() computes: the viewshed of the segment's observers on its cells.
  Request request_of(std::size_t segment) const;
  /// A number that is equal for plans with the same segments of the same request on the same store, and for no others.
  std::uint64_t id() const { return id_; }

 private:
  Request request_;
  ComputeOptions options_;
  Certainty certainty_;
  bool exactly_;
  RasterGrid grid_;
  std::vector<Segment> segments_;
  std::uint64_t id_ = 0;
};

/// Decides the segment's cells alone; `store` is the one that the plan was made for. Cost and errors are those of
/// compute_with_surface() on Plan::request_of(), or of compute_certified().
Result decide(const Store& store, const Plan& plan, std::size_t segment, Progress& progress);

class SegmentMerge;

/// Puts the results of segments together, which may come in any order. The plan must outlive it.
class Merge {
 public:
  explicit Merge(const Plan& plan);
  ~Merge();

  /// Adds a segment's result, which may have been added before. Throws InputError for a result that is not this
  /// segment's.
  void add(std::size_t segment, const Result& result);
  /// The segments that have not come, ascending.
  std::vector<std::size_t> missing() const;
  /// The whole result. The statistics are the sums of all segments'. Throws InputError while any is missing.
  Result take();

 private:
  std::unique_ptr<SegmentMerge> merge_;
};

/// Writes a segment's result. Equal results give equal bytes, except for statistics. Throws FileError; an existing file
/// is replaced once the new one is complete.
void write_segment(const std::string& path, const Plan& plan, std::size_t segment, const Result& result);

/// Throws FileError where the file cannot be read or is damaged, InputError where it holds another plan's segment or
/// another segment.
Result read_segment(const std::string& path, const Plan& plan, std::size_t segment);

}  // namespace itin::viewshed
