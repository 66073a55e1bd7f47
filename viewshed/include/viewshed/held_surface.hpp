// A surface that is kept in memory for many viewsheds: of one observer after another, from several threads at once.
// HeldSurface holds one area; PagedSurface reads others as the observers move.
//
//   const viewshed::HeldSurface surface(store, {318000, 172000, 326000, 180000}, Detail::tolerance(0),
//                                       ThemeChoice::all(), {}, progress);
//   viewshed::Request near;
//   near.observers = {{"here", {320000, 176000}, 2}};
//   near.radius = 1500;
//   const viewshed::Result result = surface.compute(near, progress);
//   // An observer who walks on, far beyond that area:
//   viewshed::PagedSurface pages(store, Detail::tolerance(0), ThemeChoice::none(), {.memory_bytes = 512 << 20});
//   double& east = near.observers.front().position.x;
//   for (; east < 400000; east += 10) std::cout << pages.compute(near, progress).cells.visible << '\n';
//   // A server shows 1 cell in 81, then 1 in 9, then all, each time the cells nearest to the observer first, until
//   // `progress` says that the observer has moved on:
//   const viewshed::Result all =
//       pages.compute(near, progress, [](const viewshed::Result& result, const viewshed::DecidedCells& cells) {
//         const RasterGrid::Cell first = cells.at(0, 0);
//         std::cout << cells.step << ' ' << static_cast<int>(result.visible[result.grid.index(first)]) << '\n';
//       });
//
// A surface is retrieved and prepared for its sight lines once for each area. A call that is cancelled throws
// Cancelled; the next call reads again what it was reading.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <itin/detail.hpp>
#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>
#include <viewshed/plan.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

class GroundCache;

/// Immutable, and safe for concurrent use.
class HeldSurface {
 public:
  /// Reads all of the store's surface over the area, which is in metres. The store must outlive this object. The memory
  /// that the surface leaves, at most a quarter of all, keeps the ground of cells between calls, 8 bytes a cell: of
  /// cells whose edges are multiples of a size that has an exact binary form, such as 0.5 or 20 metres. Throws
  /// InputError where the area takes more than the memory, and what triangulate() throws.
  HeldSurface(const Store& store, const Box& area, const Detail& detail, const ThemeChoice& themes,
              const ComputeOptions& options, Progress& progress);
  HeldSurface(Store&& store, const Box& area, const Detail& detail, const ThemeChoice& themes,
              const ComputeOptions& options, Progress& progress) = delete;
  HeldSurface(HeldSurface&&) noexcept;
  HeldSurface& operator=(HeldSurface&&) noexcept;
  ~HeldSurface();

  const Box& area() const;
  const Detail& detail() const;
  const ThemeChoice& themes() const;
  /// About how much memory the surface takes, without the ground of cells.
  std::uint64_t bytes() const;
  /// Whether every sight line of the request lies over the area, or beyond all data.
  bool covers(const Request& request) const;
  /// Computes as compute() does on the store with this surface's detail and themes, which count instead of the
  /// request's; the result is equal to the last bit. Throws InputError for a request that is not covered, and what
  /// compute() throws. `sink` gets cells as they are decided, in three passes.
  Result compute(const Request& request, Progress& progress, const CellSink& sink = {}) const;

 private:
  friend class HeldAreas;  // whose surfaces share the memory for the ground of cells
  HeldSurface(const Store& store, const Box& area, const Detail& detail, const ThemeChoice& themes,
              const ComputeOptions& options, std::shared_ptr<GroundCache> ground, Progress& progress);
  friend Result decide(const HeldSurface& surface, const Plan& plan, std::size_t segment, Progress& progress);
  class Impl;
  std::unique_ptr<const Impl> impl_;
};

/// Areas of a store's surface, which are read as requests leave the areas held. Safe for concurrent use.
///
/// An area consists of whole squares of a fixed grid. It is larger than the request by an eighth of its width or more
/// on every side, so that an observer may move on without reading; where the memory does not hold that much, it is
/// smaller. A new area displaces the areas that were used longest ago, but a call that runs over them keeps them until
/// it ends. Threads that need the same area read it once.
class PagedSurface {
 public:
  /// `options.memory_bytes` bounds all areas and the ground of cells that is kept for them together, beside what each
  /// running call takes for itself. The store must outlive this object.
  PagedSurface(const Store& store, const Detail& detail, const ThemeChoice& themes, const ComputeOptions& options = {});
  PagedSurface(Store&& store, const Detail& detail, const ThemeChoice& themes, const ComputeOptions& options) = delete;
  PagedSurface(PagedSurface&&) noexcept;
  PagedSurface& operator=(PagedSurface&&) noexcept;
  ~PagedSurface();

  const Detail& detail() const;
  const ThemeChoice& themes() const;
  /// The areas that are held, the one used last first.
  std::vector<Box> areas() const;
  /// How many areas have been read since this object was made.
  std::uint64_t readings() const;

  /// Reads the surface over a box, metres, towards which requests move, so that they do not wait for it. Does nothing
  /// where an area holds it, or the memory does not hold it beside the area used last. Throws what triangulate()
  /// throws.
  void prefetch(const Box& box, Progress& progress);

  /// Computes as compute() does on the store with this surface's detail and themes, which count instead of the
  /// request's; the result is equal to the last bit. A request whose surface exceeds the memory is computed from the
  /// store, in segments. It leaves the areas used last that take no more than half of the memory, but where the other
  /// half is too little for it. Throws what compute() throws. `sink` gets cells as they are decided, in three passes
  /// where an area holds the surface.
  Result compute(const Request& request, Progress& progress, const CellSink& sink = {});

 private:
  friend Result decide(PagedSurface& surface, const Plan& plan, std::size_t segment, Progress& progress);
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Decides a segment as decide() on the plan's store does, equal to the last bit. The surface must be of that store,
/// and have the plan's detail and themes; for a certified plan its tolerance must be 0. Throws InputError where it has
/// others, where its area does not hold the segment, or where the plan is over a coarse level (see
/// Plan::decides_exactly()). Also throws what compute() throws.
Result decide(const HeldSurface& surface, const Plan& plan, std::size_t segment, Progress& progress);
/// Decides a segment over an area read for the whole plan, or for the segment alone where the memory does not hold the
/// plan's.
Result decide(PagedSurface& surface, const Plan& plan, std::size_t segment, Progress& progress);

}  // namespace itin::viewshed
