// Pairs of a dwelling and a turbine in groups, each with the ground under their lines, as large as the memory holds.
//
//   for (const DwellingSegment& segment : dwelling_segments(store, request, pairs, progress))
//     triangulate(store, segment.surface, ...);
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <itin/window.hpp>
#include <viewshed/dwellings.hpp>

#include "plan/effort.hpp"

namespace itin::viewshed {

/// A dwelling and a turbine, and where lines between them lead.
struct DwellingPair {
  std::size_t dwelling = 0, turbine = 0;
  bool in_shadow = false;  ///< the turbine's shadow may reach the dwelling
  Box eyes;                ///< about the dwelling's eyes
  Box ends;                ///< about the far ends of lines from them
};

struct DwellingSegment {
  std::vector<DwellingPair> pairs;
  Window surface = Window::all();  ///< all ground under their lines
  std::uint64_t points = 0;        ///< about as many as the bare surface has
};

/// Divides the pairs. Segments do not change an answer. Throws InputError where the memory does not hold the ground of
/// a single pair, Cancelled.
std::vector<DwellingSegment> dwelling_segments(const Store& store, const DwellingsRequest& request,
                                               std::vector<DwellingPair> pairs, const Progress& progress);

/// About how long a segment takes.
Effort effort_of_dwellings(const DwellingSegment& segment);

}  // namespace itin::viewshed
