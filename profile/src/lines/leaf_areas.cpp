#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/error.hpp>
#include <itin/feature_at.hpp>
#include <itin/feature_numbers.hpp>
#include <profile/leaf_areas.hpp>

namespace itin::profile {

namespace {

void require_sound(const Foliage& foliage) {
  const auto refuse = [](const char* field, double value, const char* expected) {
    throw InputError(fmt::format("`{}`: {:g} is not {}", field, value, expected), field);
  };
  const auto is_size = [](double v) { return std::isfinite(v) && v >= 0; };
  if (!is_size(foliage.extinction)) refuse("extinction", foliage.extinction, "a number of at least 0");
  if (!is_size(foliage.leaf_area)) refuse("leaf_area", foliage.leaf_area, "a number of at least 0");
  if (!(foliage.least_transmittance >= 0 && foliage.least_transmittance <= 1))
    refuse("least_transmittance", foliage.least_transmittance, "a share from 0 to 1");
}

}  // namespace

LeafAreas::LeafAreas(const Store& store, const ThemeChoice& themes, const Foliage& foliage)
    : store_(store), foliage_(foliage), vegetation_{false} {
  require_sound(foliage);
  std::vector<std::string> names, fields;
  for (const ThemeInfo& theme : store.metadata().themes) {
    const bool chosen = theme.kind == ThemeKind::Vegetation && theme.is_raised() && themes.includes(theme);
    vegetation_.push_back(chosen);
    if (!chosen || foliage.leaf_area_field.empty()) continue;
    names.push_back(theme.name);
    for (const AttributeField& field : theme.fields) fields.push_back(field.name);
    read_field(static_cast<std::uint16_t>(vegetation_.size() - 1));
  }
  if (foliage.leaf_area_field.empty() || !by_feature_.empty()) return;
  throw InputError(names.empty() ? std::string("`leaf_area`: no theme of vegetation is chosen that could have a field")
                                 : fmt::format("`leaf_area`: {} has no field '{}'; {}", fmt::join(names, ", "),
                                               foliage.leaf_area_field,
                                               fields.empty() ? "import with `attributes` to keep fields"
                                                              : fmt::format("there is {}", fmt::join(fields, ", "))),
                   "leaf_area");
}

void LeafAreas::read_field(std::uint16_t theme) {
  std::vector<std::optional<double>> areas = feature_numbers(store_, theme, foliage_.leaf_area_field);
  if (areas.empty()) return;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    if (!areas[i] || *areas[i] >= 0) continue;
    const auto feature = features_numbered(store_, theme, {static_cast<std::int64_t>(i)})[0];
    throw InputError(fmt::format("`leaf_area`: {}, {} has a leaf area of {:g} in '{}'; it must not be negative",
                                 store_.metadata().themes[theme - std::size_t{1}].name,
                                 feature ? title_of(*feature) : std::to_string(i), *areas[i], foliage_.leaf_area_field),
                     "leaf_area");
  }
  by_feature_.emplace(theme, std::move(areas));
}

std::vector<double> LeafAreas::at(std::span<const FoliageStretch> stretches, const std::vector<Point2>& places) const {
  std::vector<double> areas(stretches.size(), foliage_.leaf_area);
  for (const auto& [theme, of_features] : by_feature_) {
    std::vector<std::size_t> wanted;
    std::vector<Point2> within;
    for (std::size_t i = 0; i < stretches.size(); ++i)
      if (stretches[i].theme == theme) wanted.push_back(i), within.push_back(places[i]);
    const auto found = features_at(store_, theme, within);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const auto number = found[i] ? static_cast<std::size_t>(found[i]->number) : of_features.size();
      if (number < of_features.size() && of_features[number]) areas[wanted[i]] = *of_features[number];
    }
  }
  return areas;
}

double LeafAreas::transmittance(std::span<const FoliageStretch> stretches, std::span<const double> leaf_areas) const {
  double leaves = 0;
  for (std::size_t i = 0; i < stretches.size(); ++i) leaves += stretches[i].length_m * leaf_areas[i];
  return std::exp(-foliage_.extinction * leaves);
}

}  // namespace itin::profile
