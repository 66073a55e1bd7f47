#include "output/file_names.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <itin/file_name.hpp>

namespace itin::cli {

bool FileNames::insert(const std::string& path) {
  std::string lower = path;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return taken_.insert(std::move(lower)).second;
}

std::string FileNames::add(const std::string& name, std::size_t number) {
  std::string file = file_name(name);
  while (!insert(file)) file += fmt::format("-{}", number);
  return file;
}

}  // namespace itin::cli
