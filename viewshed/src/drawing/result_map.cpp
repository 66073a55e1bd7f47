#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <viewshed/area_text.hpp>
#include <viewshed/result_map.hpp>

#include "drawing/map_overlay.hpp"
#include "turbines/value_bands.hpp"

namespace itin::viewshed {

namespace {

Rgba colour_of(const Tint& tint) {
  return {tint.colour.red, tint.colour.green, tint.colour.blue,
          static_cast<std::uint8_t>(std::lround(255 * tint.opacity))};
}

std::string key_text(const std::string& what, std::uint64_t cells, std::uint64_t of, double cell_area) {
  return fmt::format("{}: {} ({:.1f} %)", what,
                     part_text(static_cast<double>(cells) * cell_area, static_cast<double>(of) * cell_area),
                     100.0 * static_cast<double>(cells) / static_cast<double>(of));
}

}  // namespace

ResultMap result_map(const Result& result, const MapOptions& options) {
  const MapOverlay overlay(result, options);
  ResultMap map;
  map.cells.resize(result.grid.cell_count(), kTransparent);
  for (std::size_t i = 0; i < map.cells.size(); ++i)
    if (const auto tint = overlay.at(i)) map.cells[i] = colour_of(*tint);
  for (const MapOverlay::Key& key : overlay.keys()) {
    std::vector<Rgba> colours;
    for (const Tint& tint : key.tints) colours.push_back(colour_of(tint));
    if (colours.empty()) colours.push_back(kTransparent);
    map.keys.push_back({std::move(colours), key.text});
  }
  map.scale_title = overlay.scale_title();
  for (const MapOverlay::Step& step : overlay.scale()) map.scale.push_back({{colour_of(step.tint)}, step.text});
  return map;
}

ResultMap result_map(const VisibilityIndex& index) {
  const std::vector<ValueBand> bands = share_bands();
  std::vector<std::uint64_t> cells(bands.size());
  ResultMap map;
  map.cells.resize(index.share.size(), kTransparent);
  for (std::size_t i = 0; i < index.share.size(); ++i) {
    if (std::isnan(index.share[i])) continue;
    const std::size_t b = band_of(bands, index.share[i]);
    ++cells[b];
    map.cells[i] = over_relief(bands[b].colour);
  }
  for (std::size_t b = 0; b < bands.size(); ++b) {
    map.keys.push_back(
        {{over_relief(bands[b].colour)},
         key_text(bands[b].label, cells[b], std::max<std::uint64_t>(1, index.observers), index.grid.cell_area())});
  }
  return map;
}

}  // namespace itin::viewshed
