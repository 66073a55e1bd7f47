#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/counted.hpp>
#include <itin/sources_in.hpp>
#include <itin/stated_heights.hpp>

namespace itin {

namespace {

/// The most names of sources of one sort in a line of text.
constexpr std::size_t kMostNames = 8;

/// Describes all of a source but its name.
std::string about(const SourceInfo& source, const StatedHeights& heights) {
  std::string text = source.theme.empty() ? "" : fmt::format("{} in theme {}", source.kind, source.theme);
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  if (source.theme.empty() && source.spacing > 0) add(fmt::format("posts every {} m", significant(source.spacing, 4)));
  if (const std::string text_of_heights = heights.text_of(source); !text_of_heights.empty()) add(text_of_heights);
  if (!source.note.empty()) add(source.note);
  return text;
}

}  // namespace

std::string name_and_checksum(const std::string& path, const std::string& sha256) {
  constexpr std::size_t kDigits = 12;
  const std::string name = std::filesystem::path(path).filename().string();
  return sha256.empty() ? name : fmt::format("{} (SHA-256 {})", name, sha256.substr(0, kDigits));
}

std::vector<std::string> described(const std::vector<SourceInfo>& sources, const StoreMetadata& metadata) {
  const StatedHeights heights(metadata);
  std::vector<std::pair<std::vector<std::string>, std::string>> sorts;  // names, and what they have in common
  for (const SourceInfo& source : sources) {
    const std::string text = about(source, heights);
    if (sorts.empty() || sorts.back().second != text) sorts.push_back({{}, text});
    sorts.back().first.push_back(name_and_checksum(source.path, source.sha256));
  }
  std::vector<std::string> lines;
  for (auto& [names, text] : sorts) {
    const std::size_t more = names.size() - std::min(names.size(), kMostNames);
    names.resize(names.size() - more);
    const std::string rest = more > 0 ? fmt::format(" and {} more", more) : "";
    lines.push_back(fmt::format("{}{}{}{}", fmt::join(names, ", "), rest, text.empty() ? "" : ": ", text));
  }
  return lines;
}

}  // namespace itin
