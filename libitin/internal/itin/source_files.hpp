// The files that a data set is read from.
#pragma once

#include <string>
#include <vector>

namespace itin {

/// Returns the files that GDAL reads for a raster or vector file: the file itself, its sidecars, and the files that a
/// virtual one (.vrt) names. Empty where the file is no data set. Opens the file.
std::vector<std::string> source_files(const std::string& path);

}  // namespace itin
