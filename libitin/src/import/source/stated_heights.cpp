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
  if (source.source_crs.empty() || lies_on_ground(source)) return std::nullopt;
  return axes_.at(source.source_crs);
}

bool StatedHeights::lies_on_ground(const SourceInfo& source) const {
  const auto theme = std::find_if(metadata_.themes.begin(), metadata_.themes.end(),
                                  [&](const ThemeInfo& t) { return t.name == source.theme; });
  return theme != metadata_.themes.end() && !is_terrain(theme->kind) && !theme->is_raised();
}

}  // namespace itin
