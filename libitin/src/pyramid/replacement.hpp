// The rules of --replace: such ground replaces ground that is no finer within its coverage; and all ground replaces the
// sea.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "pyramid/points/working_index.hpp"

namespace itin {

/// Drops every point of a source that lies in the coverage (coverage.hpp) of the replacing sources of finer spacing.
/// Replacing sources of equal spacing count too where the source does not replace others itself. Drops every point of
/// the sea (kSea) that lies in the coverage of all ground. Each coverage is that of its sources together. Points of
/// these sources themselves stay, and so do points at one of the ascending codes `kept`. Returns the number dropped.
/// The rule knows no order of import. `gap_bases` are in grid units.
std::uint64_t drop_replaced(WorkingIndex& index, const std::vector<CurveRange>& tiles,
                            const std::vector<SourceInfo>& sources, const std::vector<std::array<double, 4>>& gap_bases,
                            const std::vector<std::uint64_t>& kept, Progress& progress);

}  // namespace itin
