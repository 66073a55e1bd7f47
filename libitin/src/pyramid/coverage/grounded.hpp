// Tells which single positions lie on the ground of some sources (coverage.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pyramid/points/source_index.hpp"

namespace itin {

/// Returns the given Morton codes that lie in a ground triangle of the points, borders included; ascending. `gap_bases`
/// holds a basis per source, in grid units.
///
/// All corners of a ground triangle lie within the gap of each other. So points farther from the codes are read only
/// where they may lie in such a triangle's circle. Other triangles, which may span half the land, are not looked at.
std::vector<std::uint64_t> grounded(std::span<const std::uint64_t> codes, const SourceIndex& points,
                                    const std::vector<std::array<double, 4>>& gap_bases);

}  // namespace itin
