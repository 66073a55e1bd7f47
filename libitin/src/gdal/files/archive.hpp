// Vector files within a .zip, as they are handed on.
#pragma once

#include <string>

namespace itin {

/// Returns GDAL's name of the one vector file or table in a .zip, or `path` where that is no .zip. Throws FileError for
/// an archive with several, or with none, whose message says that `what` is missing.
std::string within_archive(const std::string& path, const std::string& what = "vector file or table");

}  // namespace itin
