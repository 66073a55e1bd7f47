#include "import/raised_warnings.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "import/source/findings.hpp"

namespace itin {

namespace {

/// How many features of a theme no longer stand.
std::uint64_t lost(const RaisedThemeReport& theme, const StoreMetadata* before) {
  if (before == nullptr) return 0;
  const auto found = std::find_if(before->themes.begin(), before->themes.end(),
                                  [&](const ThemeInfo& t) { return t.name == theme.name && t.is_raised(); });
  return found == before->themes.end() || found->features <= theme.built ? 0 : found->features - theme.built;
}

}  // namespace

std::vector<std::string> raised_warnings(const RaisedFeaturesReport& raised, const StoreMetadata* before,
                                         const std::vector<std::uint16_t>& added) {
  std::vector<std::string> warnings;
  for (const RaisedThemeReport& theme : raised.themes) {
    const std::uint64_t fewer = lost(theme, before);
    Findings findings(fmt::format("theme '{}'", theme.name));
    if (fewer > 0) findings.add(fmt::format("{} of its features stood before, and do not on this ground", fewer));
    for (const RaisedReport& report : theme.reports)
      if (fewer > 0 || std::find(added.begin(), added.end(), report.source) != added.end()) findings.add(report.text);
    for (std::string& line : findings.lines()) warnings.push_back(std::move(line));
  }
  return warnings;
}

}  // namespace itin
