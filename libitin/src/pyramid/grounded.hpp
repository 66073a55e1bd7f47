// Which single positions lie on the ground of some sources (coverage.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pyramid/source_index.hpp"

namespace itin {

/// The Morton codes, out of those given, that lie in a ground triangle of the points, borders included; ascending.
/// `gap_bases` per source, grid units.
///
/// All corners of a ground triangle lie within the gap of each other. So what is farther from the codes is read only
/// where it may lie in such a triangle's circle, and other triangles, which may span half the land, are not looked at.
std::vector<std::uint64_t> grounded(std::span<const std::uint64_t> codes, const SourceIndex& points,
                                    const std::vector<std::array<double, 4>>& gap_bases);

}  // namespace itin
