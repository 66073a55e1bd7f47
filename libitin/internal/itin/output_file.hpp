// Small output files, either complete or absent.
#pragma once

#include <string>
#include <string_view>

namespace itin {

/// Writes to a temporary name beside `path` and renames. Throws FileError if the file exists and may not be replaced,
/// or cannot be written.
void write_file(const std::string& path, std::string_view bytes, bool overwrite);

}  // namespace itin
