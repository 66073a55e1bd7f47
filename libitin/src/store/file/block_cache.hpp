// A cache of decoded blocks and directory chunks, which gives up the least recently used first. All threads share it;
// it is sharded, so that they seldom wait for each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>

namespace itin {

class BlockCache {
 public:
  explicit BlockCache(std::uint64_t bytes) : shard_bytes_(bytes / kShards) {}

  /// Returns null where there is no such entry.
  std::shared_ptr<const void> find(std::uint64_t key);
  /// Keeps the value, unless it is larger than a shard. Where the key is there already, the first entry stays.
  void insert(std::uint64_t key, std::shared_ptr<const void> value, std::size_t bytes);
  /// Removes the entry, if there is one.
  void erase(std::uint64_t key);
  /// Returns the bytes held now, at most the budget.
  std::uint64_t bytes();

 private:
  struct Entry {
    std::uint64_t key;
    std::shared_ptr<const void> value;
    std::size_t bytes;
  };
  struct alignas(64) Shard {
    std::mutex mutex;
    std::list<Entry> entries;  ///< most recently used first
    std::unordered_map<std::uint64_t, std::list<Entry>::iterator> index;
    std::uint64_t bytes = 0;
  };

  static constexpr std::size_t kShards = 16;
  // Neighbours along the curve go to different shards.
  Shard& shard(std::uint64_t key) { return shards_[(key * 0x9e3779b97f4a7c15u) >> 60]; }

  std::uint64_t shard_bytes_;
  std::array<Shard, kShards> shards_;
};

}  // namespace itin
