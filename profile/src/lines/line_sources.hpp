// The sources of the surface under a line.
#pragma once

#include <string>
#include <vector>

#include <itin/store.hpp>
#include <profile/los.hpp>

namespace itin::profile {

/// Lists the sources of the triangles that the line crosses or comes near to; in the store's order. Throws
/// CorruptStore.
std::vector<SourceInfo> sources_under(const Store& store, const StoreLine& line);

/// A line of text for each sort of sources: their names, posting, vertical datum and note.
std::vector<std::string> described(const std::vector<SourceInfo>& sources, const StoreMetadata& metadata);

}  // namespace itin::profile
