#include <algorithm>

#include <itin/feature_cuts.hpp>

#include "store/store_file.hpp"

namespace itin {

std::vector<Certificate> feature_cuts(const Store& store, const ThemeChoice& themes, const Box& box) {
  const StoreMetadata& metadata = store.metadata();
  std::vector<Certificate> cuts;
  if (!metadata.has_foundations) return cuts;
  for (std::size_t p = 0; p < metadata.parts.size(); ++p) {
    if (!themes.includes(metadata.themes[metadata.parts[p].theme - std::size_t{1}])) continue;
    const auto number = static_cast<std::uint16_t>(metadata.themes.size() + p + 1);
    std::vector<Certificate::Cell> cells = file_of(store).cuts(number, metadata.grid.enclosing(box));
    if (!cells.empty()) cuts.emplace_back(std::move(cells));
  }
  return cuts;
}

std::int32_t deepest_cut(const std::vector<Certificate>& cuts, const GridBox& box) {
  std::int32_t deepest = 0;
  for (const Certificate& cut : cuts)
    if (const auto bounds = cut.over(box)) deepest = std::max(deepest, -bounds->lo);
  return deepest;
}

}  // namespace itin
