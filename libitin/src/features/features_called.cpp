#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/error.hpp>
#include <itin/feature_at.hpp>
#include <itin/likely_meant.hpp>
#include <itin/parsed_number.hpp>
#include <itin/plain_text.hpp>
#include <itin/sort_unique.hpp>
#include <itin/store.hpp>

namespace itin {

namespace {

[[noreturn]] void refuse_name(const std::string& name, const std::string& why) {
  throw InputError(fmt::format("`without` '{}': {}", name, why), "without");
}

/// The name of a feature in its parts.
struct FeatureName {
  std::uint16_t theme = 0;
  bool by_number = false;
  std::string feature;
};

/// Splits a name at the longest name of a theme that it begins with.
FeatureName parts_of(const std::string& name, const StoreMetadata& metadata) {
  FeatureName parts;
  std::size_t length = 0;
  std::vector<std::string> raised;
  for (std::size_t t = 0; t < metadata.themes.size(); ++t) {
    const std::string& theme = metadata.themes[t].name;
    if (!metadata.themes[t].is_raised()) continue;
    raised.push_back(theme);
    if (!name.starts_with(theme) || name.size() == theme.size() || theme.size() < length) continue;
    const char separator = name[theme.size()];
    if (separator != ':' && separator != '#' && separator != ',') continue;
    parts = {static_cast<std::uint16_t>(t + 1), separator == '#', without_outer_blanks(name.substr(theme.size() + 1))};
    length = theme.size();
  }
  if (parts.theme != 0) return parts;
  if (raised.empty()) refuse_name(name, "the store has no features that stand on the ground");
  if (std::find(raised.begin(), raised.end(), name) != raised.end())
    refuse_name(name, fmt::format("names no feature; give {}:ID, or leave out the whole theme by `themes`", name));
  const std::string theme = name.substr(0, name.find_first_of(":#,"));
  refuse_name(name, fmt::format("give THEME:ID or THEME#NUMBER, where THEME is one of {}{}", fmt::join(raised, ", "),
                                did_you_mean(theme, raised)));
}

/// Finds features of one theme.
class FeatureNames {
 public:
  FeatureNames(const Store& store, std::uint16_t theme)
      : theme_(store.metadata().themes[theme - std::size_t{1}].name), features_(features_of(store, theme)) {
    for (std::size_t i = 0; i < features_.size(); ++i)
      for (const std::string& name : names_of(features_[i])) by_name_.emplace(name, i);
  }

  /// `given` is the whole name, for messages.
  std::int64_t number_of(const std::string& feature, bool by_number, const std::string& given) const {
    if (features_.empty()) refuse_name(given, fmt::format("the theme {} has no features", theme_));
    if (by_number) return of_number(feature, given);
    std::vector<std::size_t> found;
    for (auto [at, end] = by_name_.equal_range(feature); at != end; ++at) found.push_back(at->second);
    sort_unique(found);
    if (found.empty()) refuse_name(given, fmt::format("{} has no such feature; {}", theme_, nearest(feature)));
    if (found.size() > 1)
      refuse_name(given, fmt::format("{} features are called so; give {}", found.size(), some(found)));
    return features_[found.front()].number;
  }

 private:
  static std::vector<std::string> names_of(const FeatureAt& feature) {
    std::vector<std::string> names{feature.name, feature.id, title_of(feature)};
    std::erase(names, "");
    return names;
  }

  std::int64_t of_number(const std::string& text, const std::string& given) const {
    const auto last = static_cast<std::int64_t>(features_.size()) - 1;
    const bool digits = !text.empty() && text.size() < 18 && text.find_first_not_of("0123456789") == std::string::npos;
    if (!digits)
      refuse_name(given, fmt::format("give the number of a feature of {} after #, from 0 to {}", theme_, last));
    const std::int64_t number = std::stoll(text);
    if (number > last)
      refuse_name(given, fmt::format("{0} has features {0}#0 to {0}#{1}; the nearest is {0}#{1}, {2}", theme_, last,
                                     title_of(features_.back())));
    return number;
  }

  std::string some(const std::vector<std::size_t>& found) const {
    std::vector<std::string> numbers;
    for (std::size_t i = 0; i < std::min<std::size_t>(found.size(), 5); ++i)
      numbers.push_back(fmt::format("{}#{}", theme_, features_[found[i]].number));
    return fmt::format("{}{}", fmt::join(numbers, " or "), found.size() > 5 ? " ..." : "");
  }

  /// Names the features whose ids are nearest: by value where the given one is a number, else by letters.
  std::string nearest(const std::string& feature) const {
    std::vector<std::string> names;
    for (const auto& [name, i] : by_name_) names.push_back(name);
    if (const auto value = whole_text_as<double>(feature)) {
      std::vector<std::pair<double, std::string>> away;
      for (const FeatureAt& f : features_)
        if (const auto id = whole_text_as<double>(f.id)) away.emplace_back(std::abs(*id - *value), f.id);
      std::sort(away.begin(), away.end());
      if (away.size() == 1) return fmt::format("the nearest is {}:{}", theme_, away[0].second);
      if (!away.empty())
        return fmt::format("the nearest are {0}:{1} and {0}:{2}", theme_, away[0].second, away[1].second);
    }
    const auto meant = likely_meant(feature, names);
    return fmt::format("{} {}:{}", meant ? "the nearest is" : "the first is", theme_,
                       meant ? *meant : names_of(features_.front()).front());
  }

  std::string theme_;
  std::vector<FeatureAt> features_;
  std::multimap<std::string, std::size_t> by_name_;
};

}  // namespace

std::vector<FeatureNumber> features_called(const Store& store, const std::vector<std::string>& names) {
  std::map<std::uint16_t, FeatureNames> themes;
  std::vector<FeatureNumber> features;
  for (const std::string& name : names) {
    const FeatureName parts = parts_of(name, store.metadata());
    const auto& theme = themes.try_emplace(parts.theme, store, parts.theme).first->second;
    features.push_back({parts.theme, theme.number_of(parts.feature, parts.by_number, name)});
  }
  return features;
}

}  // namespace itin
