// --replace: ground takes the place of ground that is no finer within its own coverage; and all ground that of the sea.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "pyramid/working_index.hpp"

namespace itin {

/// Drops every point of a source that lies in the coverage (coverage.hpp) of the replacing sources of finer spacing, or
/// of equal spacing where it does not replace others itself, and every point of the sea (kSea) in that of all ground,
/// taken together, unless it is one of theirs or stands at one of
/// the ascending codes `kept`; returns how many. The rule knows no order of import. `gap_bases` in grid units.
std::uint64_t drop_replaced(WorkingIndex& index, const std::vector<CurveRange>& tiles,
                            const std::vector<SourceInfo>& sources, const std::vector<std::array<double, 4>>& gap_bases,
                            const std::vector<std::uint64_t>& kept, Progress& progress);

}  // namespace itin
