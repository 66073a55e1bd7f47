// A list without repetitions, in ascending order.
#pragma once

#include <algorithm>

namespace itin {

/// Sorts a container, such as std::vector, and removes repetitions. O(n log n).
template <class Container>
void sort_unique(Container& items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

}  // namespace itin
