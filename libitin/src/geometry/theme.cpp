#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/error.hpp>
#include <itin/theme.hpp>

namespace itin {

namespace {

constexpr std::array<std::string_view, 9> kKinds{"contours",  "breaklines", "water",   "roads",   "walls",
                                                 "buildings", "vegetation", "surface", "terraces"};

}  // namespace

std::string_view name_of(ThemeKind kind) {
  return kKinds.at(static_cast<std::size_t>(kind));
}

std::string_view name_of(AttributeType type) {
  constexpr std::array<std::string_view, 3> kTypes{"number", "whole", "text"};
  return kTypes.at(static_cast<std::size_t>(type));
}

ThemeKind theme_kind(std::string_view name) {
  const auto* found = std::find(kKinds.begin(), kKinds.end(), name);
  if (found == kKinds.end())
    throw InputError(fmt::format("kind of theme '{}': give one of {}", name, fmt::join(kKinds, ", ")), "kind");
  return static_cast<ThemeKind>(found - kKinds.begin());
}

bool ThemeInfo::leaves_out(std::int64_t feature) const {
  const auto run =
      std::partition_point(left_out.begin(), left_out.end(), [&](const FeatureRun& r) { return r.last < feature; });
  return run != left_out.end() && run->first <= feature;
}

std::uint64_t ThemeInfo::left_out_count() const {
  std::uint64_t count = 0;
  for (const FeatureRun& run : left_out) count += static_cast<std::uint64_t>(run.last - run.first + 1);
  return count;
}

bool comes_before(const ThemeInfo& a, const ThemeInfo& b) {
  const auto rank = [](const ThemeInfo& theme) {
    switch (theme.kind) {
      case ThemeKind::Buildings:
      case ThemeKind::Terraces:
        return 0;
      case ThemeKind::Walls:
        return 1;
      case ThemeKind::Surface:
        return 3;
      default:
        return 2;
    }
  };
  return std::pair(rank(a), std::string_view(a.name)) < std::pair(rank(b), std::string_view(b.name));
}

ThemeChoice ThemeChoice::parse(std::string_view text) {
  if (text == "all") return all();
  if (text == "none") return none();
  std::vector<std::string> names;
  while (true) {
    const std::size_t comma = text.find(',');
    names.emplace_back(text.substr(0, comma));
    if (names.back().empty()) throw InputError("themes: expected all, none, or names with commas between", "themes");
    if (comma == std::string_view::npos) return ThemeChoice(false, std::move(names));
    text.remove_prefix(comma + 1);
  }
}

ThemeChoice ThemeChoice::with_ground_lines() const {
  ThemeChoice choice = *this;
  choice.ground_lines_ = true;
  return choice;
}

ThemeChoice ThemeChoice::without_vegetation() const {
  ThemeChoice choice = *this;
  choice.vegetation_ = false;
  return choice;
}

ThemeChoice ThemeChoice::omitting(std::vector<OmittedFeature> features, std::shared_ptr<const OmittedTops> tops) const {
  ThemeChoice choice = *this;
  choice.omitted_ = std::move(features);
  choice.tops_ = std::move(tops);
  return choice;
}

bool ThemeChoice::omits(std::uint16_t theme, std::int64_t feature) const {
  return std::any_of(omitted_.begin(), omitted_.end(),
                     [&](const OmittedFeature& f) { return f.theme == theme && f.number == feature; });
}

bool ThemeChoice::includes(const ThemeInfo& theme) const {
  if (is_terrain(theme.kind)) return true;
  if (!theme.is_raised() && !ground_lines_) return false;
  if (theme.kind == ThemeKind::Vegetation && !vegetation_) return false;
  return all_ || std::find(names_.begin(), names_.end(), theme.name) != names_.end();
}

bool ThemeChoice::includes_raised(const std::vector<ThemeInfo>& themes) const {
  return std::any_of(themes.begin(), themes.end(), [&](const ThemeInfo& t) { return t.is_raised() && includes(t); });
}

void ThemeChoice::check(const std::vector<ThemeInfo>& themes) const {
  for (const std::string& name : names_) {
    if (std::any_of(themes.begin(), themes.end(), [&](const ThemeInfo& t) { return t.name == name; })) continue;
    std::vector<std::string> known;
    for (const ThemeInfo& theme : themes) known.push_back(theme.name);
    throw InputError(fmt::format("theme '{}': the store has none of this name; it has {}", name,
                                 known.empty() ? "no themes" : fmt::format("{}", fmt::join(known, ", "))),
                     "themes");
  }
}

std::vector<std::string> ThemeChoice::names(const std::vector<ThemeInfo>& themes) const {
  check(themes);
  std::vector<std::string> included;
  for (const ThemeInfo& theme : themes) {
    if (includes(theme)) included.push_back(theme.name);
  }
  return included;
}

}  // namespace itin
