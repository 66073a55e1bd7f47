// Links of buildings and masts in groups, each with the ground on the way, as large as the memory holds.
//
//   for (const PremisesSegment& segment : premises_segments(store, request, masts, reached, progress))
//     triangulate(store, segment.surface, ...);
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <itin/building_outlines.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <itin/window.hpp>
#include <viewshed/premises.hpp>

#include "plan/effort.hpp"

namespace itin::viewshed {

/// A building and some of the masts that reach it, by their numbers.
struct BuildingLinks {
  std::size_t foot = 0;
  std::vector<std::size_t> masts;
};

struct PremisesSegment {
  std::vector<BuildingLinks> buildings;  ///< each once
  Window surface = Window::all();        ///< all ground between masts and buildings
  Window ground = Window::all();         ///< the ground about the buildings
  std::uint64_t points = 0;              ///< about as many as the bare surface has
};

/// A building, and the masts that reach it.
struct ReachedBuilding {
  std::size_t foot = 0;            ///< its number
  Box box;                         ///< about its places
  std::vector<std::size_t> masts;  ///< none where its places alone are looked for
};

/// Divides the links of the buildings, which lie in any order. Those of one building may come in several segments, its
/// first masts first. Segments do not change an answer. Throws InputError where the memory does not hold the ground of
/// a single link, Cancelled.
std::vector<PremisesSegment> premises_segments(const Store& store, const PremisesRequest& request,
                                               const std::vector<SitePosition>& masts,
                                               std::vector<ReachedBuilding> buildings, const Progress& progress);

/// About how long a segment takes.
Effort effort_of_premises(const PremisesSegment& segment);

}  // namespace itin::viewshed
