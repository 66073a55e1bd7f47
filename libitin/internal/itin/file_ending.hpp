// The ending of a file's name, which tells its format.
//
//   if (ending_of("Garth.TIF") == ".tif") ...
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace itin {

/// Returns the ending with its dot, in lower case; empty where there is none.
inline std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace itin
