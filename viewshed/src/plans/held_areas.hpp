// The areas of a paged surface: which to read for a request, which to drop for it, and which thread reads.
#pragma once

#include <cstdint>
#include <future>
#include <list>
#include <memory>
#include <mutex>
#include <vector>

#include <itin/call_progress.hpp>
#include <itin/store.hpp>
#include <viewshed/held_surface.hpp>

#include "plan/memory.hpp"
#include "scene/ground_cache.hpp"

namespace itin::viewshed {

/// Safe for concurrent use.
class HeldAreas {
 public:
  HeldAreas(const Store& store, const Detail& detail, const ThemeChoice& themes, const ComputeOptions& options);

  /// Returns a surface over all of `whole`, of triangles where they are needed; or over `part` of it, where the memory
  /// does not hold the whole; or null where it does not hold the part either. Reading is a step of the call. Throws
  /// what reading throws.
  std::shared_ptr<const HeldSurface> get(const Box& whole, const Box& part, SurfaceForm needed, CallProgress& call);
  /// Reads a surface over the box where no area holds it, and the memory holds it beside the area used last. Throws
  /// what reading throws.
  void prefetch(const Box& box, CallProgress& call);
  /// Drops the areas used longest ago until what is left, and the ground of cells on it, takes no more than this, and
  /// returns what that takes; areas that running calls use end with these calls.
  std::uint64_t keep(std::uint64_t most_bytes);

  std::vector<Box> areas() const;
  std::uint64_t readings() const;

 private:
  using Surface = std::shared_ptr<const HeldSurface>;
  struct Area {
    Box box;
    SurfaceForm form;
    std::uint64_t bytes;           ///< about
    std::promise<Surface> read{};  ///< null where reading failed
    std::shared_future<Surface> surface = read.get_future().share();
  };
  struct Claim {
    std::shared_ptr<Area> area;  ///< null: none that the memory holds
    bool to_read = false;        ///< whoever claims the area must read it
  };

  Claim claim(const Box& whole, const Box& part, SurfaceForm needed);
  std::shared_ptr<Area> claim_beside_last(const Box& box);
  std::shared_ptr<Area> find(const Box& box, SurfaceForm needed);
  std::shared_ptr<Area> area_about(const Box& box, SurfaceForm needed) const;
  std::uint64_t most_for_areas() const;
  void add(std::shared_ptr<Area> area);
  std::uint64_t drop_surplus(std::uint64_t most_bytes);
  Surface read(const std::shared_ptr<Area>& area, CallProgress& call);
  void give_up(Area& area);

  const Store& store_;
  Detail detail_;
  ThemeChoice themes_;
  ComputeOptions options_;
  bool is_full_;                         ///< the full surface is held, not a coarser one
  std::shared_ptr<GroundCache> ground_;  ///< the cells' ground, on all areas
  mutable std::mutex mutex_;
  std::list<std::shared_ptr<Area>> areas_;  ///< the one used last first
  std::uint64_t readings_ = 0;
};

}  // namespace itin::viewshed
