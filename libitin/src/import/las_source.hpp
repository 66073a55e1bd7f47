// LAS and LAZ files as sources of terrain.
#pragma once

#include <memory>
#include <string>

#include <itin/import.hpp>

#include "import/point_reader.hpp"
#include "import/source_context.hpp"

namespace itin {

/// The points of options.classes (by default all but noise, 7 and 18), without withheld ones. LAZ needs a build with
/// PDAL. Throws FileError (not LAS, damaged, LAZ without PDAL), InputError (a class outside 0 to 255).
std::unique_ptr<PointReader> open_las_reader(const std::string& path, const ImportOptions& options);

/// The same, as a source in the importer's two steps.
std::unique_ptr<SourceFile> open_las_source(const std::string& path, const ImportOptions& options);

}  // namespace itin
