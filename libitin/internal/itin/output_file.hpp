// Small output files, either complete or absent.
#pragma once

#include <string>
#include <string_view>

namespace itin {

/// Writes to a temporary name beside `path` and renames. Throws FileError if the file exists and may not be replaced,
/// or cannot be written.
void write_file(const std::string& path, std::string_view bytes, bool overwrite);

/// Throws FileError where a file could not be written at `path`: one exists that may not be replaced, it is a folder,
/// or in a folder that does not exist. Whoever writes several files asks for all of them before the first.
void require_output_possible(const std::string& path, bool overwrite);

}  // namespace itin
