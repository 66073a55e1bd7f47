// The cells of a result, of an index or of a zone, whether it holds them in memory or has them part by part.
//
//   std::uint64_t seen = 0;
//   for_each_part(result, [&](const Result& part, RasterGrid::Cell north_west) {
//     for (const Verdict verdict : part.visible) seen += verdict == Verdict::kVisible;
//   });
#pragma once

#include <itin/raster.hpp>

namespace itin::viewshed {

/// Calls use(part, north_west) for each part of a whole. One that holds its cells is its own only part.
template <class Whole, class Use>
void for_each_part(const Whole& whole, const Use& use) {
  if (!whole.parts) return use(whole, RasterGrid::Cell{});
  whole.parts->for_each(use);
}

}  // namespace itin::viewshed
