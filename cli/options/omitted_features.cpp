#include "options/omitted_features.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/plain_text.hpp>

namespace itin::cli {

namespace {

std::vector<std::string> names_between(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(without_outer_blanks(part));
  return parts;
}

}  // namespace

std::vector<std::string> omitted_in(const std::string& text) {
  std::error_code none;
  std::vector<std::string> names;
  if (std::filesystem::is_regular_file(text, none)) {
    std::ifstream file(text, std::ios::binary);
    std::ostringstream content;
    if (!(content << file.rdbuf())) throw FileError(text, "cannot be read, or is empty; give a feature in each line");
    names = names_between(content.str(), '\n');
    std::erase(names, "");
    if (names.empty()) throw FileError(text, "names no features; give one in each line, such as woods:17");
    return names;
  }
  names = names_between(text, ';');
  if (names.empty() || std::find(names.begin(), names.end(), "") != names.end())
    throw InputError(
        fmt::format("--without '{}': give features with semicolons between, such as woods:17;woods:18, or "
                    "a file with one in each line",
                    text));
  return names;
}

}  // namespace itin::cli
