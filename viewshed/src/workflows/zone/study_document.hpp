// What documents say of a study, part by part.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <itin/document.hpp>
#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

/// Tells whether viewpoints were asked for.
inline bool has_viewpoints(const ZoneStudyRequest& request) {
  return !request.viewpoints.viewpoints.empty() || request.viewpoints.rows > 0;
}

/// Tells how many of a file's rows were used, and why the others were not.
Document bad_rows_document(const std::string& file, std::size_t rows, std::size_t used, const std::vector<BadRow>& bad);
std::string bad_row_warning(const std::string& file, const BadRow& row);

/// Returns a row that is not used, with what its table knows of it.
template <class Table>
BadRow bad_row(const Table& table, std::size_t number, std::string message) {
  const std::size_t row = number - 1;
  return {number, row < table.features.size() ? table.features[row] : 0,
          row < table.places.size() ? table.places[row] : "", std::move(message)};
}

/// Returns `surface`: the surface that sight lines pass over.
Document study_surface(const ZoneStudy& study);

}  // namespace itin::viewshed
