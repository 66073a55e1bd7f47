// The files that a data set is read from.
#pragma once

#include <string>
#include <vector>

namespace itin {

/// What GDAL reads of a raster or vector file: itself, its sidecars, and of a virtual one (.vrt) the files that it
/// names. Empty for what is no data set. Opens it.
std::vector<std::string> source_files(const std::string& path);

}  // namespace itin
