// Houses that stand in a store.
//
//   test::import_houses(path("s.itin"), path("h.geojson"), {test::box(300100, 199700, 300140, 199730, 9)});
#pragma once

#include <string>
#include <vector>

#include <itin/import.hpp>
#include <itin/progress.hpp>

#include "support/vector_file.hpp"

namespace itin::test {

/// Writes the outlines to the file and imports them as the theme `houses`, each as high as its field h says.
inline void import_houses(const std::string& store, const std::string& file, const std::vector<LineFeature>& houses) {
  write_lines(file, houses, true);
  ImportOptions options;
  options.sources = {file};
  options.kind = ThemeKind::Buildings;
  options.theme = "houses";
  options.height_field = "h";
  NoProgress progress;
  import_lines(store, options, progress);
}

}  // namespace itin::test
