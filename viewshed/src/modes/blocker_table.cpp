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
  for (const std::uint32_t blocker : result.blocker)
    if (blocker < kMissingGround) hides[blocker] = true;
  std::vector<std::uint32_t> place(numbers_.size());
  result.blockers.clear();
  for (const auto& [triangle, number] : numbers_) {
    if (!hides[number]) continue;
    place[number] = static_cast<std::uint32_t>(result.blockers.size());
    result.blockers.push_back(triangle);
  }
  result.blocker_theme.resize(result.blocker.size());
  for (std::size_t cell = 0; cell < result.blocker.size(); ++cell) {
    std::uint32_t& blocker = result.blocker[cell];
    if (blocker < kMissingGround) blocker = place[blocker];
    result.blocker_theme[cell] = blocker < kMissingGround ? result.blockers[blocker].theme : blocker;
  }
}

}  // namespace itin::viewshed
