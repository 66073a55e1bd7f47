// Tells whether a path is a file at all, before any reader looks into it, and what it is where no reader could read it.
#pragma once

#include <string>

namespace itin {

/// Throws FileError for a path that exists, but is empty, a pipe or device, or may not be read. A name without a file,
/// and a directory, may still be a data set: only reading tells. Names that begin with /vsi are GDAL's.
void require_plain_file(const std::string& path);

/// Tells whether nothing has that name, GDAL's names of files within others included. Throws FileError where only a
/// request that is not allowed would tell.
bool is_missing(const std::string& path);

/// Explains why a reader has failed: there is no such file, it is a directory, or it is a raster where `what` ("a layer
/// of points") was wanted; else returns GDAL's message. Precondition: a QuietGdal lives.
std::string why_not_read(const std::string& path, const std::string& what);

}  // namespace itin
