// Names of files made from names that people give.
//
//   file_name("Mast 3/4")    // "Mast_3_4"
#pragma once

#include <string>

namespace itin {

/// Returns the name with an underscore for each character that some file systems do not allow.
std::string file_name(const std::string& name);

}  // namespace itin
