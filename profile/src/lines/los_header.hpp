// Gathers what a report's header and maps say about a line over a store besides its verdict.
#pragma once

#include <itin/store.hpp>
#include <profile/los.hpp>

namespace itin::profile {

/// Adds the places of both ends and the distance between them on the ellipsoid, the names of themes and features, the
/// facts about store and surface, and the lines about both ends. Throws InputError where an end has no longitude and
/// latitude.
void add_header(const Store& store, const StoreLine& line, LosReport& report);

}  // namespace itin::profile
