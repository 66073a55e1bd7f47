// All bytes of a file.
#pragma once

#include <fstream>
#include <iterator>
#include <string>

namespace itin::test {

inline std::string file_bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace itin::test
