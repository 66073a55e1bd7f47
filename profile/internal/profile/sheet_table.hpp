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
  double first_column = 0.2;                        ///< its part of the width; the others share the rest
  std::string elsewhere = {};                       ///< the file that has all rows
};

}  // namespace itin::profile
