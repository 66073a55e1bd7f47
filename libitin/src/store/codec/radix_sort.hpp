// Sorts short keys without comparisons, which processors cannot predict.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace itin {

/// Sorts in ascending order of key(item), an unsigned integer below 2^key_bits; equal keys stay in order. O(n) per byte
/// of key.
template <class Item, class Key>
void radix_sort(std::vector<Item>& items, int key_bits, const Key& key) {
  using Keyed = std::pair<std::uint64_t, Item>;
  std::vector<Keyed> from, to(items.size());
  from.reserve(items.size());
  for (const Item& item : items) from.emplace_back(key(item), item);
  for (int shift = 0; shift < key_bits; shift += 8) {
    std::array<std::uint32_t, 257> first{};
    for (const Keyed& k : from) ++first[(k.first >> shift & 0xff) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    for (const Keyed& k : from) to[first[k.first >> shift & 0xff]++] = k;
    from.swap(to);
  }
  for (std::size_t i = 0; i < items.size(); ++i) items[i] = from[i].second;
}

}  // namespace itin
