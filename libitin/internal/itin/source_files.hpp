// The files that a data set is read from.
#pragma once

#include <string>
#include <vector>

namespace itin {

/// The files that GDAL reads for a raster or vector file: itself, its sidecars, and the files that a virtual one (.vrt)
/// names. Empty where it is no data set. Opens it.
std::vector<std::string> source_files(const std::string& path);

}  // namespace itin
