// The cells of a result, whether it holds them in memory or has them part by part.
//
//   std::uint64_t seen = 0;
//   for_each_part(result, [&](const Result& part) {
//     for (const Verdict verdict : part.visible) seen += verdict == Verdict::kVisible;
//   });
#pragma once

#include <viewshed/result.hpp>

namespace itin::viewshed {

/// Calls use(part) for each part of a result. One that holds its cells is its own only part.
template <class Use>
void for_each_part(const Result& result, const Use& use) {
  if (!result.parts) return use(result);
  result.parts->for_each([&](const Result& part, RasterGrid::Cell) { use(part); });
}

}  // namespace itin::viewshed
