// Buildings in groups, each with the masts that reach them and the ground on the way, as large as the memory holds.
//
//   for (const PremisesSegment& segment : premises_segments(store, request, masts, reached))
//     triangulate(store, segment.surface, ...);
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <itin/building_outlines.hpp>
#include <itin/store.hpp>
#include <itin/window.hpp>
#include <viewshed/premises.hpp>

#include "plan/effort.hpp"

namespace itin::viewshed {

struct PremisesSegment {
  std::vector<std::size_t> buildings;  ///< their numbers
  std::vector<std::size_t> masts;      ///< those that reach one of them
  Window surface = Window::all();      ///< all ground between masts and buildings
  Window ground = Window::all();       ///< the ground about the buildings
  std::uint64_t points = 0;            ///< about as many as the bare surface has
};

/// A building that masts reach.
struct ReachedBuilding {
  std::size_t foot = 0;  ///< its number
  Box box;               ///< about its places
  std::vector<std::size_t> masts;
};

/// Divides the buildings, which lie in any order. Segments do not change an answer.
std::vector<PremisesSegment> premises_segments(const Store& store, const PremisesRequest& request,
                                               const std::vector<SitePosition>& masts,
                                               std::vector<ReachedBuilding> buildings);

/// About how long a segment takes.
Effort effort_of(const PremisesSegment& segment);

}  // namespace itin::viewshed
