// What a description (VRT, MRF) may not do: read as raw bytes, or as a table, what lies outside its folder, and run
// code. Whoever sends such a file could otherwise have any file of this machine read as terrain.
#pragma once

#include <string>

namespace itin {

/// Returns why the description must not be opened; empty where it may. `name` is a file, or the description itself as
/// GDAL takes it in place of a name.
std::string foreign_content(const std::string& name);

/// Tells from the first bytes of a file whether foreign_content() should see it.
bool is_description(const std::string& first_bytes);

}  // namespace itin
