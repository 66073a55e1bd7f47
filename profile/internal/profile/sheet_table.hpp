// A table on a sheet of paper.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace itin::profile {

/// A table with headings over some columns. Rows for which there is no room are counted below the others.
struct SheetTable {
  struct Heading {
    std::string text;  ///< may be empty
    std::size_t columns = 1;
  };
  std::string title = {};                           ///< may be empty
  std::vector<Heading> headings = {};               ///< over the header, from the first column on
  std::vector<std::vector<std::string>> rows = {};  ///< the header first
  /// Its part of the width, while the others share the rest alike. Where that would cut a text, columns are as wide as
  /// their texts are.
  double first_column = 0.2;
  std::string rest = {};  ///< what the rows are that are left out, the last ones; may be empty
};

}  // namespace itin::profile
