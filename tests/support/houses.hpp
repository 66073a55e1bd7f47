// Features that stand in a store.
//
//   test::import_houses(path("s.itin"), path("h.geojson"), {test::box(300100, 199700, 300140, 199730, 9)});
#pragma once

#include <string>
#include <vector>

#include <itin/import.hpp>
#include <itin/progress.hpp>

#include "support/vector_file.hpp"

namespace itin::test {

/// Writes the outlines to the file and imports them as a theme, each as high as its field h says.
inline ImportReport import_raised(const std::string& store, const std::string& file, ThemeKind kind,
                                  const std::string& theme, const std::vector<LineFeature>& features,
                                  ImportOptions options = {}) {
  write_lines(file, features, true);
  options.sources = {file};
  options.kind = kind;
  options.theme = theme;
  options.height_field = "h";
  NoProgress progress;
  return import_lines(store, options, progress);
}

/// Imports houses in the same way, as the theme `houses`.
inline void import_houses(const std::string& store, const std::string& file, const std::vector<LineFeature>& houses) {
  import_raised(store, file, ThemeKind::Buildings, "houses", houses);
}

}  // namespace itin::test
