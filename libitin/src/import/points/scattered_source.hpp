// Scattered points of any file as terrain in the store's projection.
#pragma once

#include <memory>

#include <itin/import.hpp>

#include "import/source/point_reader.hpp"
#include "import/source/source_context.hpp"

namespace itin {

/// Chooses the CRS (options.crs, else the reader's) and what the heights mean by source_heights().
///
/// After reading, SourceInfo::spacing is the mean point spacing: the square root of bounding-box area over number. For
/// points nearly on a line it is the line's length over their number. The gap is options.max_gap, or 100 times the
/// spacing. Throws InputError for a CRS that is missing or not understood.
std::unique_ptr<SourceFile> scattered_source(std::unique_ptr<PointReader> reader, const ImportOptions& options);

/// The widest gap, in metres, in which ground is triangulated where the call gives none.
double default_gap(const Box& bounds, std::uint64_t points);

}  // namespace itin
