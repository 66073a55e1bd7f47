#include "modes/blocker_table.hpp"

#include <algorithm>

namespace itin::viewshed {

std::vector<std::uint32_t> BlockerTable::numbers_of(std::span<const BlockingTriangle> triangles) {
  std::vector<std::uint32_t> numbers;
  const std::lock_guard lock(mutex_);
  for (const BlockingTriangle& triangle : triangles)
    numbers.push_back(numbers_.try_emplace(triangle, static_cast<std::uint32_t>(numbers_.size())).first->second);
  return numbers;
}

void BlockerTable::give(Result& result) const {
  // A blocker that hid a cell from one observer may have given way to one that hides it from a nearer observer.
  std::vector<bool> hides(numbers_.size());
  auto& [triangles, of_cells, themes, features] = result.get<Blockers>();
  for (const std::uint32_t blocker : of_cells)
    if (blocker < kMissingGround) hides[blocker] = true;
  std::vector<std::uint32_t> place(numbers_.size());
  triangles.clear();
  for (const auto& [triangle, number] : numbers_) {
    if (!hides[number]) continue;
    place[number] = static_cast<std::uint32_t>(triangles.size());
    triangles.push_back(triangle);
  }
  themes.resize(of_cells.size());
  for (std::size_t cell = 0; cell < of_cells.size(); ++cell) {
    std::uint32_t& blocker = of_cells[cell];
    if (blocker < kMissingGround) blocker = place[blocker];
    themes[cell] = blocker < kMissingGround ? triangles[blocker].theme : blocker;
  }
}

}  // namespace itin::viewshed
