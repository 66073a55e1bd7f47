#include "cli/command_case.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

namespace itin::test {

namespace {

void add_line(std::vector<CommandCase>& cases, const std::string& file, int number, const std::string& line) {
  static const std::set<std::string> kExpectations = {"stdout", "stderr", "no-stdout", "no-stderr",
                                                      "json",   "file",   "no-file"};
  const std::size_t space = line.find(' ');
  const std::string word = line.substr(0, space);
  const std::string rest = space == std::string::npos ? "" : line.substr(space + 1);
  if (word == "case") {
    CommandCase& begun = cases.emplace_back();
    begun.file = file, begun.line = number, begun.name = rest;
    return;
  }
  if (cases.empty()) throw std::runtime_error(fmt::format("{}:{}: no case has begun", file, number));
  CommandCase& current = cases.back();
  if (word == "run") {
    current.runs.push_back(rest);
  } else if (word == "needs" && rest == "store") {
    current.needs_store = true;
  } else if (word == "not" && rest == "sanitized") {
    current.not_sanitized = true;
  } else if (word == "status") {
    current.status = std::stoi(rest);
  } else if (kExpectations.contains(word)) {
    current.expectations.push_back({word, rest, number});
  } else {
    throw std::runtime_error(fmt::format("{}:{}: '{}' is not understood", file, number, line));
  }
}

}  // namespace

std::vector<CommandCase> read_cases(const std::string& directory) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    if (entry.path().extension() == ".cases") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<CommandCase> cases;
  for (const auto& path : files) {
    std::ifstream stream(path);
    std::string line;
    for (int number = 1; std::getline(stream, line); ++number) {
      if (!line.empty() && line.front() != '#') add_line(cases, path.filename().string(), number, line);
    }
  }
  return cases;
}

}  // namespace itin::test
