// Whether a path is a file at all, before any reader looks into it, and what it is where none could read it.
#pragma once

#include <string>

namespace itin {

/// Throws FileError for a path that exists, but is empty, a pipe or device, or may not be read. A name of no file may
/// still be a dataset's, and a directory may be a dataset: reading tells. Names that begin with /vsi are GDAL's.
void require_plain_file(const std::string& path);

/// Whether there is nothing under that name, GDAL's names of files within others included.
bool is_missing(const std::string& path);

/// In place of a reader that has failed: that there is no such file, that it is a directory, or a raster where `what`
/// ("a layer of points") was wanted; else what GDAL says. Within the life of a QuietGdal.
std::string why_not_read(const std::string& path, const std::string& what);

}  // namespace itin
