// The sources of the surface within a box, and the lines of reports about sources.
//
//   for (const std::string& line : described(sources_in(store, grid.bounds(), themes), store.metadata()))
//     std::cout << line << '\n';
#pragma once

#include <string>
#include <vector>

#include <itin/store.hpp>
#include <itin/theme.hpp>

namespace itin {

/// Returns the sources that have a vertex in the box, metres, of the terrain or of the themes, in the store's order.
/// Reads the points there until all sources are found; in a store of one source, that source is returned wherever the
/// store's bounds meet the box. Throws CorruptStore.
std::vector<SourceInfo> sources_in(const Store& store, const Box& box, const ThemeChoice& themes);

/// Returns the name of a file without its folders, and the beginning of its checksum where that is known.
std::string name_and_checksum(const std::string& path, const std::string& sha256);

/// Returns a line of text for each sort of sources: their names, posting, vertical datum and note.
std::vector<std::string> described(const std::vector<SourceInfo>& sources, const StoreMetadata& metadata);

}  // namespace itin
