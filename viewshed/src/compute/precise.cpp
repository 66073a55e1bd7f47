#include <algorithm>
#include <utility>

#include <viewshed/certified.hpp>

#include "compute/lattice_sectors.hpp"
#include "compute/store_viewshed.hpp"
#include "compute/tin_segments.hpp"
#include "request/request.hpp"
#include "window/near_ground.hpp"

namespace itin::viewshed {

namespace {

/// Of the rasters that hold what is known of every cell.
constexpr std::uint64_t kBytesACell = 6;
/// The rest is for the store's cache, and for what is freed but not given back.
constexpr std::uint64_t kSectorShare = 2;

/// What the rasters leave of the memory, or a quarter of it.
std::uint64_t memory_beside_rasters(std::uint64_t memory, std::uint64_t cells) {
  const std::uint64_t rasters = std::min(memory, kBytesACell * cells);
  return std::max(memory / 4, memory - rasters);
}

}  // namespace

Surveyed compute_precise(const Store& store, const Request& request, const PreciseOptions& options,
                         Progress& progress) {
  validate(request);
  Request whole = request;
  whole.detail = Detail::tolerance(0);
  const Box box = box_of_window(store, request);
  const std::uint64_t memory =
      memory_beside_rasters(options.memory_bytes, cells_of(request, extent_of(store)).cell_count());
  const std::uint64_t points = store.points_about(0, box);
  if (options.lattices && points <= memory / kBytesAPost)
    if (auto surveyed = compute_over_lattice(store, whole, memory / kBytesAPost, progress)) return std::move(*surveyed);
  if (points <= memory / kBytesAPoint) return compute_over_tin(store, whole, progress);
  if (options.lattices)
    if (auto surveyed = compute_by_lattice_sectors(store, whole, memory / kSectorShare, progress))
      return std::move(*surveyed);
  return compute_in_tin_segments(store, request, memory, progress);
}

}  // namespace itin::viewshed
