// A surface that is kept in memory for many viewsheds: of one observer after another, from several threads at once.
//
//   const viewshed::HeldSurface surface(store, {318000, 172000, 326000, 180000}, Detail::tolerance(0),
//                                       ThemeChoice::all(), {}, progress);
//   viewshed::Request near;
//   near.observers = {{"here", {320000, 176000}, 2}};
//   near.radius = 1500;
//   const viewshed::Result result = surface.compute(near, progress);
//
// Retrieval and what prepares a surface for its sight lines are paid once.
#pragma once

#include <memory>

#include <itin/detail.hpp>
#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// Immutable, and safe for concurrent use.
class HeldSurface {
 public:
  /// All of the store's surface over the area, metres. The store must outlive it. Throws InputError where the area
  /// takes more than the memory, and what triangulate() throws.
  HeldSurface(const Store& store, const Box& area, const Detail& detail, const ThemeChoice& themes,
              const ComputeOptions& options, Progress& progress);
  HeldSurface(Store&& store, const Box& area, const Detail& detail, const ThemeChoice& themes,
              const ComputeOptions& options, Progress& progress) = delete;
  HeldSurface(HeldSurface&&) noexcept;
  HeldSurface& operator=(HeldSurface&&) noexcept;
  ~HeldSurface();

  const Box& area() const;
  /// Whether every sight line of the request lies over the area, or beyond all data.
  bool covers(const Request& request) const;
  /// As compute() on the store with this surface's detail and themes, which count instead of the request's; equal to
  /// the last bit. Throws InputError for a request that is not covered, and as compute() does.
  Result compute(const Request& request, Progress& progress) const;

 private:
  class Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace itin::viewshed
