// The points of LAS and LAZ files that are ground to stand on, so far as their classes tell.
#pragma once

#include <memory>
#include <string>

#include <itin/import.hpp>

#include "import/source/point_reader.hpp"

namespace itin {

/// Opens a reader of the points of options.classes (by default all but noise, 7 and 18), without withheld ones.
/// Throws FileError (not LAS, damaged, or LAZ that is not read), InputError (a class outside 0 to 255).
std::unique_ptr<PointReader> open_las_reader(const std::string& path, const ImportOptions& options);

}  // namespace itin
