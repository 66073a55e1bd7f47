#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <viewshed/qgis_styles.hpp>
#include <viewshed/result_parts.hpp>

#include "files/verdict_classes.hpp"
#include "turbines/value_bands.hpp"

namespace itin::viewshed {

namespace {

/// The lower a target is seen, the darker: from the ground on.
std::vector<ValueBand> height_bands() {
  constexpr std::array<Rgba, kMastHeightLimits.size() + 2> kBlues{
      {{8, 48, 107}, {8, 88, 158}, {43, 140, 190}, {78, 179, 211}, {123, 204, 196}, {168, 221, 181}, {224, 243, 219}}};
  std::vector<ValueBand> bands = limit_bands({kMastHeightLimits.begin(), kMastHeightLimits.end()}, "m");
  bands.front().label = "0 m: the ground is seen";
  for (std::size_t i = 0; i < bands.size(); ++i) bands[i].colour = kBlues[i];
  return bands;
}

/// Returns the observers of a set of the first 32, by name or else by number from 1.
std::string names_of_set(const std::vector<Observer>& observers, std::uint32_t set) {
  std::string names;
  for (std::size_t i = 0; i < std::min<std::size_t>(32, observers.size()); ++i) {
    if ((set & raster_bit(i).mask) == 0) continue;
    if (!names.empty()) names += " + ";
    names += observers[i].name.empty() ? std::to_string(i + 1) : observers[i].name;
  }
  return names;
}

std::string style_of_sets(const Result& result) {
  std::map<std::uint32_t, std::uint64_t> cells;
  for_each_part(result, [&](const Result& part, RasterGrid::Cell) {
    for (const std::uint32_t set : std::span(part.get<ObserverSets>().words).first(part.grid.cell_count()))
      if (set != 0) ++cells[set];
  });
  std::vector<std::pair<std::uint32_t, std::uint64_t>> commonest_first(cells.begin(), cells.end());
  std::ranges::stable_sort(commonest_first, std::ranges::greater(), &std::pair<std::uint32_t, std::uint64_t>::second);
  std::vector<StyleClass> sets;
  for (const auto& [set, count] : commonest_first) sets.push_back({set, names_of_set(result.request.observers, set)});
  return commonest_style(std::move(sets));
}

std::string style_of_blockers(const Result& result) {
  const std::vector<std::uint32_t>& themes = result.get<Blockers>().theme;
  const std::set<std::uint32_t> present(themes.begin(), themes.end());
  std::vector<StyleClass> style;
  for (const std::uint32_t theme : present) {
    if (theme == 0) style.push_back({0, "terrain", {139, 115, 85}});
    if (theme == kMissingGround) style.push_back({theme, "ground without data", kUndecidedGrey});
    if (theme > 0 && theme <= result.theme_names.size())
      style.push_back({theme, result.theme_names[theme - 1], distinct_colour(theme - 1)});
  }
  return class_style(style);
}

}  // namespace

bool has_qgis_style(Mode mode) {
  return mode != Mode::kAngle && mode != Mode::kNearest;
}

std::string qgis_style(const Result& result) {
  switch (result.request.mode) {
    case Mode::kVisible:
    case Mode::kFresnel:
      return class_style(verdict_classes(result));
    case Mode::kCount:
      return banded_style(count_bands(result.request.observers.size()));
    case Mode::kWhich:
      return style_of_sets(result);
    case Mode::kBlocker:
      return style_of_blockers(result);
    case Mode::kProbability:
      return banded_style(limit_bands({0.05, 0.25, 0.5, 0.75, 0.95}, "of the surfaces"));
    case Mode::kLoss:
      return banded_style(loss_bands());
    case Mode::kLevel:
      return banded_style(level_bands(result.request));
    case Mode::kHeight:
      return banded_style(height_bands());
    case Mode::kAngle:
    case Mode::kNearest:
      return "";
  }
  return "";
}

std::string qgis_style(const std::vector<RasterClass>& classes) {
  return class_style(classes);
}

std::string qgis_style_of_shares() {
  return banded_style(share_bands());
}

std::string style_beside(const std::string& raster) {
  return std::filesystem::path(raster).replace_extension(".qml").string();
}

}  // namespace itin::viewshed
