// Tells how far a clearance over a coarse surface may lie from the one over the full surface.
#pragma once

#include <itin/detail.hpp>
#include <itin/geometry.hpp>
#include <itin/theme.hpp>

namespace itin {
class Store;
}

namespace itin::profile {

/// The error, in metres, for a line between two places with both ends standing on the surface asked for. It is the sum
/// of the width of the certified error about the line, the greatest height of features that are left out at this
/// detail, and the depth to which flat foundations cut into the ground. 0 at full detail. (Where the ground between a
/// feature and the next coarse vertices slopes otherwise than without the feature, the certificate does not say by how
/// much.) Throws CorruptStore.
double clearance_error(const Store& store, const Detail& detail, const ThemeChoice& themes, Point2 from, Point2 to);

}  // namespace itin::profile
