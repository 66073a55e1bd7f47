// The lattice that the points of a box seem to lie on.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "geometry/post_lattice.hpp"
#include "store/codec/point_index.hpp"

namespace itin {

/// Returns the lattice that most points of the box lie on, as far as the fullest of these leaves tell, which are so
/// many voters; nothing where there are no leaves. Each leaf votes by itself, because a single point off the lattice
/// spoils that of its leaf. Points may lie elsewhere: whoever stands on the lattice has to look at each of them.
std::optional<PostLattice> prevailing_lattice(const PointIndex& index, std::span<const Leaf> leaves, const GridBox& box,
                                              std::size_t voters = 8);

}  // namespace itin
