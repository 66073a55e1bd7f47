// How much of a store's surface is read at once, under a memory budget.
#include "exact/compute.hpp"

#include <algorithm>
#include <utility>

#include <itin/call_progress.hpp>
#include <viewshed/surface.hpp>
#include <viewshed/viewshed.hpp>

#include "exact/lattice_sectors.hpp"
#include "exact/store_viewshed.hpp"
#include "exact/tin_segments.hpp"
#include "modes/feature_names.hpp"
#include "plan/memory.hpp"
#include "request/request.hpp"
#include "request/request_window.hpp"
#include "window/retrieval.hpp"

namespace itin::viewshed {

namespace {

/// Fewer points are read in less time than it takes to look at what is hidden.
constexpr std::uint64_t kPointsWorthALook = 500000;

/// A sector takes one part in this many of the memory; the rest is for the store's cache, and for what is freed but not
/// given back.
constexpr std::uint64_t kSectorShare = 2;

/// Tells whether an irregular surface is large, and little of it may be seen.
bool may_be_mostly_hidden(const Store& store, const Request& request, std::uint64_t points) {
  return points >= kPointsWorthALook && request.observers.size() == 1 && reads_what_may_be_seen(store, request);
}

/// Computes in the first way that the memory allows.
ViewshedWithSurface climb(const Store& store, const Request& request, const ComputeOptions& options,
                          Progress& progress) {
  const std::uint64_t memory = memory_beside_rasters(options.memory_bytes, store, request);
  const std::uint64_t points = points_about(store, request.detail, box_of_window(store, request));
  const bool lattice = options.lattices && takes_a_lattice(store, request);
  if (lattice && points <= memory / kBytesPerPost)
    if (auto computed = compute_over_lattice(store, request, memory / kBytesPerPost, options.sink, progress))
      return std::move(*computed);
  const bool whole = options.whole_surface || !may_be_mostly_hidden(store, request, points);
  if (whole && points <= memory / bytes_per_point(request))
    return compute_over_tin(store, request, options.sink, progress);
  if (lattice)
    if (auto computed = compute_by_lattice_sectors(store, request, memory / kSectorShare, options.sink, progress))
      return std::move(*computed);
  return compute_in_tin_segments(store, request, memory, options.sink, progress);
}

}  // namespace

ViewshedWithSurface compute_with_surface(const Store& store, const Request& request, const ComputeOptions& options,
                                         Progress& progress) {
  validate(request);
  require_memory_for_rasters(store, request, options.memory_bytes);
  CallProgress call(progress);
  ViewshedWithSurface computed = climb(store, request, options, call);
  name_features(store, computed.result, call);
  call.finish();
  return computed;
}

Result compute_result(const Store& store, const Request& request, ComputeOptions options, Progress& progress) {
  options.whole_surface = false;
  return compute_with_surface(store, request, options, progress).result;
}

Result compute(const Store& store, const Request& request, Progress& progress) {
  return compute_result(store, request, {}, progress);
}

Request request_for_observer(const Result& result, std::size_t observer) {
  Request request = result.request;
  request.observers = {result.request.observers[observer]};
  request.cell_size.reset();
  request.grid = result.grid;
  return request;
}

}  // namespace itin::viewshed
