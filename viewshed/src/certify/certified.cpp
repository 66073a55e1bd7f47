#include "certify/certified.hpp"

#include <fmt/format.h>

#include <itin/call_progress.hpp>
#include <itin/error.hpp>
#include <itin/level_choice.hpp>
#include <viewshed/viewshed.hpp>

#include "certify/level_source.hpp"
#include "plan/memory.hpp"
#include "request/request.hpp"
#include "request/request_window.hpp"

namespace itin::viewshed {

namespace {

/// Gives the exact answer, except where ground without data leaves it open.
ViewshedWithSurface decide_exactly(const Store& store, const Request& request, const ComputeOptions& options,
                                   Progress& progress) {
  Request exact = request;
  exact.detail = Detail::tolerance(0);
  ViewshedWithSurface computed = compute_with_surface(store, exact, options, progress);
  computed.result.request = request;
  computed.result.certified = computed.result.decided_exactly = true;
  return computed;
}

/// Refuses too little memory. The part of the level that is read at a time does not depend on the memory, or what it
/// leaves undecided would depend on it, too.
void require_memory(const Store& store, const Request& request, CertifiedWay way, std::uint64_t memory) {
  constexpr std::uint64_t kBytesOfBounds = 40000000;
  const int level = level_within(store.metadata(), request.detail.coarsest());
  const std::uint64_t points =
      way == CertifiedWay::kBySectors ? kPointsOfSector : store.points_about(level, box_of_window(store, request));
  const std::uint64_t bytes = points * kBytesPerEnvelopePoint + kBytesOfBounds;
  if (bytes > memory)
    throw InputError(
        fmt::format("the level takes {:.0f} MB at a time: give more `memory_bytes`, a coarser tolerance or "
                    "a smaller `radius`",
                    static_cast<double>(bytes) / 1e6),
        "memory_bytes");
}

}  // namespace

ViewshedWithSurface compute_certified(const Store& store, const Request& request, const ComputeOptions& options,
                                      Progress& progress) {
  return compute_certified(store, request, certified_way(store, request), options, progress);
}

ViewshedWithSurface compute_certified(const Store& store, const Request& request, CertifiedWay way,
                                      const ComputeOptions& options, Progress& progress) {
  validate_certified(request);
  require_memory_for_rasters(store, request, options.memory_bytes);
  if (way == CertifiedWay::kExactly) return decide_exactly(store, request, options, progress);
  require_memory(store, request, way, options.memory_bytes);
  CallProgress call(progress);
  ViewshedWithSurface computed = way == CertifiedWay::kBySectors
                                     ? certify_by_sectors(store, request, kPointsOfSector, options.sink, call)
                                     : certify_by_blocks(store, request, options.sink, call);
  call.finish();
  return computed;
}

}  // namespace itin::viewshed
