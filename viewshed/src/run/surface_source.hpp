// A surface as viewsheds are decided over it, and the one way in which they are: every viewshed is run() over a source,
// whether its surface is read at once, sector by sector or segment by segment, and whether its verdicts are exact or
// what a coarse level is certain of.
//
//   LatticeSectors source(store, request, memory);
//   const std::optional<Result> result = run(source, request, sink, progress);
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <itin/call_progress.hpp>
#include <viewshed/result.hpp>

#include "request/eye.hpp"
#include "run/viewshed_cells.hpp"

namespace itin::viewshed {

/// Eyes next to each other in the request's order.
struct EyeGroup {
  std::span<const Eye> eyes;
  std::uint32_t first = 0;  ///< the observer of the first of them
  bool last = false;        ///< no other group comes after this one
};

class SurfaceSource {
 public:
  SurfaceSource() = default;
  SurfaceSource(const SurfaceSource&) = delete;
  SurfaceSource& operator=(const SurfaceSource&) = delete;
  virtual ~SurfaceSource() = default;

  /// Sets the result's grid, ground_m and crosses_voids, and returns the observers' eyes on their ground. The result's
  /// request is given. Throws InputError for an observer outside the data.
  virtual std::vector<Eye> begin(Result& result, CallProgress& call) = 0;

  /// How many eyes decide() takes at a time.
  virtual std::size_t eyes_at_once() const { return 1; }

  /// Tells whether decide() always decides all cells, by ViewshedCells::observe_all().
  virtual bool decides_all_cells() const { return false; }

  /// Decides all that the eyes look at. Returns false where the surface turns out not to be of the source's form.
  virtual bool decide(const EyeGroup& group, ViewshedCells& cells) = 0;
};

/// Returns nothing where the surface is not of the source's form. Throws Cancelled, and what the source throws.
std::optional<Result> run(SurfaceSource& source, const Request& request, const CellSink& sink, Progress& progress);

}  // namespace itin::viewshed
