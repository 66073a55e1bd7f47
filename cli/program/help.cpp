#include "program/help.hpp"

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <sys/ioctl.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace itin::cli {

namespace {

constexpr const char* kFirstGroup = "Options";  ///< has --help alone
constexpr std::size_t kNameColumns = 30;
constexpr std::size_t kNarrowest = 60, kWidest = 120, kElsewhere = 100;

std::size_t columns_of_terminal() {
  winsize size{};
  if (isatty(STDOUT_FILENO) == 0 || ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kElsewhere;
  return std::clamp<std::size_t>(size.ws_col, kNarrowest, kWidest);
}

/// Breaks one line into several between words.
std::string broken(const std::string& line, std::size_t width) {
  std::istringstream words(line);
  std::string lines;
  std::size_t column = 0;
  for (std::string word; words >> word;) {
    const bool fits = column + 1 + word.size() <= width;
    if (column > 0) lines += fits ? ' ' : '\n';
    column = (column > 0 && fits ? column + 1 : 0) + word.size();
    lines += word;
  }
  return lines;
}

}  // namespace

void begin_group(CLI::App& app, const char* group) {
  app.option_defaults()->group(group);
}

HelpText::HelpText() {
  column_width(kNameColumns);
}

std::string HelpText::make_group(std::string group, bool positional, std::vector<const CLI::Option*> options) const {
  const std::string text = Formatter::make_group(group, positional, std::move(options));
  // Formatter puts an empty line after each group as well as before it.
  return positional || group == kFirstGroup ? text : text.substr(1);
}

std::string HelpText::make_option_desc(const CLI::Option* option) const {
  const std::size_t width = columns_of_terminal() - kNameColumns;
  std::istringstream description(option->get_description());
  std::string lines;
  for (std::string line; std::getline(description, line);) lines += (lines.empty() ? "" : "\n") + broken(line, width);
  return lines;
}

}  // namespace itin::cli
