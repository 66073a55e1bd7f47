#include <algorithm>

#include <itin/error.hpp>
#include <itin/stated_heights.hpp>

namespace itin {

namespace {

std::optional<HeightAxis> axis_in(const std::string& crs) {
  try {
    return height_axis(crs);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

StatedHeights::StatedHeights(const StoreMetadata& metadata) : metadata_(metadata) {
  for (const SourceInfo& source : metadata.sources)
    if (const std::string& crs = source.source_crs; !crs.empty() && !axes_.contains(crs)) axes_[crs] = axis_in(crs);
}

std::optional<HeightAxis> StatedHeights::of(const SourceInfo& source) const {
  const ThemeInfo* theme = theme_of(source);
  const bool lies_on_ground = theme != nullptr && !is_terrain(theme->kind) && !theme->is_raised();
  if (source.source_crs.empty() || lies_on_ground || !source.states_heights) return std::nullopt;
  return axes_.at(source.source_crs);
}

std::string StatedHeights::text_of(const SourceInfo& source) const {
  const std::string& raster = source.heights_from;
  if (!source.states_heights) return "heights of features from " + raster;
  const std::optional<HeightAxis> axis = of(source);
  if (!axis) return {};
  const ThemeInfo* theme = theme_of(source);
  const bool may_be_relative = theme != nullptr && theme->is_raised() && theme->kind != ThemeKind::Surface;
  const std::string stated = may_be_relative ? "heights of features, unit: " + unit_text(*axis) : described(*axis);
  return raster.empty() ? stated : stated + ", or from " + raster + " where they state none";
}

const ThemeInfo* StatedHeights::theme_of(const SourceInfo& source) const {
  const auto theme = std::find_if(metadata_.themes.begin(), metadata_.themes.end(),
                                  [&](const ThemeInfo& t) { return t.name == source.theme; });
  return theme == metadata_.themes.end() ? nullptr : &*theme;
}

}  // namespace itin
