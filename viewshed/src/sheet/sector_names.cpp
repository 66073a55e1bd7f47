#include <algorithm>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/precondition.hpp>
#include <viewshed/sector_names.hpp>

namespace itin::viewshed {

namespace {

constexpr std::string_view kAfterMast = " -_/.,:;(";    ///< what may follow a mast's name
constexpr std::string_view kBeforeSector = " -_/.,:;";  ///< what of it a sector's own name is without

std::size_t common_length(const std::vector<std::string>& names) {
  const std::string& first = names.front();
  std::size_t common = first.size();
  for (const std::string& name : names) {
    const auto differs = std::ranges::mismatch(first, name).in1;
    common = std::min(common, static_cast<std::size_t>(differs - first.begin()));
  }
  return common;
}

bool ends_or_has_mark_at(const std::string& name, std::size_t at) {
  return at == name.size() || kAfterMast.find(name[at]) != std::string_view::npos;
}

}  // namespace

std::string shared_beginning(const std::vector<std::string>& names) {
  ITIN_PRECONDITION(!names.empty());
  const std::string common = names.front().substr(0, common_length(names));
  const bool is_whole =
      std::ranges::all_of(names, [&](const std::string& name) { return ends_or_has_mark_at(name, common.size()); });
  const std::size_t end = is_whole ? common.size() : common.find_last_of(kAfterMast);
  if (end == 0 || end == std::string::npos) return "";
  return common.substr(0, common.find_last_not_of(kAfterMast, end - 1) + 1);
}

std::string names_together(const std::vector<std::string>& names) {
  ITIN_PRECONDITION(!names.empty());
  std::vector<std::string> different;
  for (const std::string& name : names)
    if (std::ranges::find(different, name) == different.end()) different.push_back(name);
  if (different.size() == 1) return different.front();
  const std::string beginning = shared_beginning(different);
  std::vector<std::string> rests;
  for (const std::string& name : different) {
    const std::size_t rest = name.find_first_not_of(kBeforeSector, beginning.size());
    if (beginning.empty() || rest == std::string::npos) return fmt::format("{}", fmt::join(different, ", "));
    rests.push_back(name.substr(rest));
  }
  return fmt::format("{} {}", beginning, fmt::join(rests, ", "));
}

}  // namespace itin::viewshed
