#include <algorithm>

#include <itin/certificate.hpp>

#include "geometry/morton_range.hpp"

namespace itin {

std::optional<HeightBounds> Certificate::over(const GridBox& box) const {
  std::optional<HeightBounds> widest;
  if (!MortonRange::exists(box)) return widest;
  const MortonRange range(box);
  auto cell = cells_.begin();
  for (std::optional<std::uint64_t> code = range.next(0); code;) {
    cell = std::upper_bound(cell, cells_.end(), *code, [](std::uint64_t c, const Cell& e) { return c < e.end; });
    if (cell == cells_.end()) break;
    if (cell->code > *code) code = range.next(cell->code);
    if (!code || *code >= cell->end) continue;
    if (!widest) widest = cell->bounds;
    widest->lo = std::min(widest->lo, cell->bounds.lo);
    widest->hi = std::max(widest->hi, cell->bounds.hi);
    code = range.next(cell->end);
  }
  return widest;
}

}  // namespace itin
