// Opens point files, by their contents, for the importer's two steps.
#pragma once

#include <memory>
#include <string>

#include <itin/import.hpp>

#include "import/source/source_context.hpp"

namespace itin {

/// Whether the name ends like delimited text: .csv, .xyz, .txt, .tsv.
bool is_delimited_text(const std::string& path);

/// Opens delimited text by its name's ending, otherwise a layer of points through GDAL. Throws FileError, InputError.
std::unique_ptr<SourceFile> open_point_source(const std::string& path, const ImportOptions& options);

/// Opens LAS or LAZ; see las_reader.hpp. Throws FileError, InputError.
std::unique_ptr<SourceFile> open_las_source(const std::string& path, const ImportOptions& options);

}  // namespace itin
