#include <algorithm>

#include <itin/likely_meant.hpp>

namespace itin {

namespace {

/// The number of letters left out, added, exchanged, or swapped with their neighbour (optimal string alignment).
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t exchanged = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, exchanged});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

/// The name without the dashes that all options have in common.
std::string_view letters(std::string_view name) {
  return name.substr(std::min(name.size(), name.find_first_not_of('-')));
}

}  // namespace

std::optional<std::string> likely_meant(std::string_view given, const std::vector<std::string>& names) {
  const std::string_view wanted = letters(given);
  std::optional<std::string> nearest;
  std::size_t least = (wanted.size() + 1) / 3 + 1;  // one letter in three may be wrong
  for (const std::string& name : names) {
    const std::string_view candidate = letters(name);
    const bool begun = wanted.size() >= 3 && candidate.starts_with(wanted);
    const std::size_t away = begun ? 1 : distance(wanted, candidate);
    if (away < least) nearest = name, least = away;
  }
  return nearest;
}

std::string did_you_mean(std::string_view given, const std::vector<std::string>& names) {
  const std::optional<std::string> meant = likely_meant(given, names);
  return meant ? "; did you mean " + *meant + "?" : "";
}

}  // namespace itin
