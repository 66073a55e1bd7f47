// The ending of a file's name, which tells its format.
//
//   if (ending_of("Garth.TIF") == ".tif") ...
#pragma once

#include <filesystem>
#include <string>

#include <itin/lower_case.hpp>

namespace itin {

/// Returns the ending with its dot, in lower case; empty where there is none.
inline std::string ending_of(const std::string& path) {
  return in_lower_case(std::filesystem::path(path).extension().string());
}

}  // namespace itin
