// How places on a roof see the street before the building: which parapet, ridge or eaves hide it, and from how high a
// pole on it comes in sight.
//
//   const std::optional<StreetSight> sight = street_sight(surface, earth, places.street, roof_place);
#pragma once

#include <optional>
#include <span>

#include <itin/earth.hpp>
#include <viewshed/premises.hpp>

#include "places/mount_places.hpp"

namespace itin::viewshed {

/// Looks from a place on a roof to the nearest place of the street, over all that is between; nothing where there is
/// none. Exact: at the pole told the street is in sight, and a grazing lower it is hidden.
std::optional<StreetSight> street_sight(const PlacedSurface& surface, const Earth& earth,
                                        std::span<const Point3> street, const RoofPlace& place);

}  // namespace itin::viewshed
