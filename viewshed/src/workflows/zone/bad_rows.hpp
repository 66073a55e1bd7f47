// What is said of rows of files that are not used.
#pragma once

#include <string>
#include <vector>

#include <itin/document.hpp>
#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

/// Tells how many of a file's rows were used, and why the others were not.
Document bad_rows_document(const std::string& file, std::size_t rows, std::size_t used, const std::vector<BadRow>& bad);
std::string bad_row_warning(const std::string& file, const BadRow& row);

}  // namespace itin::viewshed
