#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <viewshed/result_map.hpp>

#include "drawing/map_overlay.hpp"

namespace itin::viewshed {

namespace {

ResultMap::Colour colour_of(const Tint& tint) {
  return {tint.colour.red, tint.colour.green, tint.colour.blue,
          static_cast<std::uint8_t>(std::lround(255 * tint.opacity))};
}

}  // namespace

ResultMap result_map(const Result& result, const MapOptions& options) {
  const MapOverlay overlay(result, options);
  ResultMap map;
  map.cells.resize(result.grid.cell_count());
  for (std::size_t i = 0; i < map.cells.size(); ++i)
    if (const auto tint = overlay.at(i)) map.cells[i] = colour_of(*tint);
  const std::uint64_t decided = std::max<std::uint64_t>(1, result.cells.in_view());
  for (const MapOverlay::Key& key : overlay.keys()) {
    const double km2 = static_cast<double>(key.cells) * result.grid.cell_area() / 1e6;
    map.keys.push_back({key.tints.empty() ? ResultMap::Colour{} : colour_of(key.tints.back()),
                        fmt::format("{}: {:.4g} km² ({:.1f} %)", key.text, km2,
                                    100.0 * static_cast<double>(key.cells) / static_cast<double>(decided))});
  }
  map.scale_title = overlay.scale_title();
  for (const MapOverlay::Step& step : overlay.scale()) map.scale.push_back({colour_of(step.tint), step.text});
  return map;
}

}  // namespace itin::viewshed
