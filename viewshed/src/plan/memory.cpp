#include "plan/memory.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/level_choice.hpp>
#include <viewshed/surface.hpp>

#include "request/request.hpp"

namespace itin::viewshed {

namespace {

/// Counts the bytes that are kept of a cell on the way and in the end.
std::uint64_t bytes_per_cell(const Request& request) {
  constexpr std::uint64_t kVerdict = 6;
  switch (request.mode) {
    case Mode::kVisible:
    case Mode::kFresnel:
      return kVerdict;
    case Mode::kCount:
      return kVerdict + 4;
    case Mode::kWhich:
      return kVerdict + 8 * bit_grids(request.observers.size());
    case Mode::kAngle:
    case Mode::kHeight:
      return kVerdict + 8;
    case Mode::kProbability:
    case Mode::kLoss:
    case Mode::kNearest:
      return kVerdict + 20;
    case Mode::kLevel:
      return kVerdict + 28;
    case Mode::kBlocker:
      return kVerdict + 28;
  }
  return kVerdict;
}

/// Rasters of no more bytes are never too large: the program takes as much by itself.
constexpr std::uint64_t kSmallRasters = 64000000;

bool holds(std::uint64_t memory, std::uint64_t raster_bytes) {
  return raster_bytes <= std::max(memory / 4 * 3, kSmallRasters);
}

/// So little ground is never too much.
constexpr std::uint64_t kLittleGround = 64 << 20;

std::uint64_t bytes_of_rasters(const Store& store, const Request& request) {
  return bytes_per_cell(request) * cells_of(request, extent_of(store)).cell_count();
}

}  // namespace

bool takes_a_lattice(const Store& store, const Request& request) {
  // A lattice is the full surface, and at coarser levels nothing of that is looked at.
  return !needs_triangles(request) && !casts_rays(request) &&
         level_within(store.metadata(), request.detail.coarsest()) == 0;
}

bool holds_ground(std::uint64_t memory, std::uint64_t bytes) {
  return bytes <= std::max(memory, kLittleGround);
}

std::uint64_t bytes_per_point(const Request& request) {
  constexpr std::uint64_t kStudies = 150;
  const std::uint64_t studies = needs_bare_lines(request) ? 2 : needs_triangles(request) ? 1 : 0;
  return kBytesPerSurfacePoint + studies * kStudies + (casts_rays(request) ? kBytesPerPointOfRays : 0);
}

std::uint64_t points_about(const Store& store, const Detail& detail, const Box& box) {
  const StoreMetadata& metadata = store.metadata();
  std::uint64_t points = store.points_about(level_within(metadata, detail.coarsest()), box);
  for (std::size_t i = 0; i + 1 < detail.rings().size(); ++i) {
    const Ring& ring = detail.rings()[i];
    const Box finer = intersection(square_about(detail.centre(), ring.radius), box);
    if (!finer.empty()) points += store.points_about(level_within(metadata, ring.tolerance), finer);
  }
  return points;
}

std::uint64_t bytes_held(const Store& store, const Detail& detail, const Box& area, SurfaceForm form) {
  return points_about(store, detail, area) * (form == SurfaceForm::kPosts ? kBytesPerPost : kBytesPerSurfacePoint);
}

std::uint64_t memory_for_ground(std::uint64_t memory, std::uint64_t surfaces) {
  return std::min(memory / 4, memory - std::min(memory, surfaces));
}

void require_memory_for_rasters(const RasterGrid& cells, std::uint64_t bytes, std::uint64_t memory) {
  if (holds(memory, bytes)) return;
  constexpr std::uint64_t kMega = 1 << 20;  // as --memory counts
  throw InputError(
      fmt::format("{} x {} cells take about {} MB, more than three quarters of the {} MB of memory: give a greater "
                  "`cell_size`, a smaller `radius`, or more `memory_bytes`",
                  cells.columns(), cells.rows(), bytes / kMega, memory / kMega),
      "memory_bytes");
}

void require_memory_for_rasters(const Store& store, const Request& request, std::uint64_t memory) {
  require_memory_for_rasters(cells_of(request, extent_of(store)), bytes_of_rasters(store, request), memory);
}

bool holds_rasters(std::uint64_t memory, const Store& store, const Request& request) {
  return holds(memory, bytes_of_rasters(store, request));
}

std::uint64_t memory_beside(std::uint64_t raster_bytes, std::uint64_t memory) {
  return std::max(memory / 4, memory - std::min(memory, raster_bytes));
}

std::uint64_t memory_beside_rasters(std::uint64_t memory, const Store& store, const Request& request) {
  return memory_beside(bytes_of_rasters(store, request), memory);
}

}  // namespace itin::viewshed
