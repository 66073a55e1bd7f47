// The sources of the surface under a line.
#pragma once

#include <vector>

#include <itin/store.hpp>
#include <profile/los.hpp>

namespace itin::profile {

/// Lists the sources of the triangles that the line crosses or comes near to; in the store's order. Throws
/// CorruptStore.
std::vector<SourceInfo> sources_under(const Store& store, const StoreLine& line);

}  // namespace itin::profile
