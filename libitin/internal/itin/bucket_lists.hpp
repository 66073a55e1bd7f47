// Lists of items by bucket, for searches: which triangles meet a square, which edges leave a vertex.
//
//   const BucketLists edges_at(vertex_count, edges.size(), [&](std::uint32_t e, const auto& add) {
//     add(edges[e].from);
//     add(edges[e].to);
//   });
//   for (const std::uint32_t e : edges_at.in(vertex)) ...
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace itin {

/// Lists of the items' numbers, one for each of a fixed number of buckets, all in two arrays. An item may lie in
/// several buckets or none.
class BucketLists {
 public:
  BucketLists() = default;
  /// `visit(item, add)` calls add(bucket) for each bucket of an item. It is called twice for each item, and must call
  /// add() alike both times.
  template <class Visit>
  BucketLists(std::size_t buckets, std::size_t items, const Visit& visit) : first_(buckets + 1, 0) {
    const auto count = static_cast<std::uint32_t>(items);
    for (std::uint32_t i = 0; i < count; ++i) visit(i, [&](std::size_t bucket) { ++first_[bucket + 1]; });
    for (std::size_t b = 0; b < buckets; ++b) first_[b + 1] += first_[b];
    items_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < count; ++i) visit(i, [&](std::size_t bucket) { items_[next[bucket]++] = i; });
  }

  /// The items of the bucket, ascending.
  std::span<const std::uint32_t> in(std::size_t bucket) const {
    return {items_.data() + first_[bucket], first_[bucket + 1] - first_[bucket]};
  }
  std::size_t bytes() const { return (first_.capacity() + items_.capacity()) * sizeof(std::uint32_t); }

 private:
  std::vector<std::uint32_t> first_;  ///< bucket b has items_[first_[b], first_[b + 1])
  std::vector<std::uint32_t> items_;
};

}  // namespace itin
