#include "store/file/block_cache.hpp"

namespace itin {

std::shared_ptr<const void> BlockCache::find(std::uint64_t key) {
  Shard& s = shard(key);
  const std::lock_guard lock(s.mutex);
  const auto found = s.index.find(key);
  if (found == s.index.end()) return nullptr;
  s.entries.splice(s.entries.begin(), s.entries, found->second);
  return found->second->value;
}

void BlockCache::insert(std::uint64_t key, std::shared_ptr<const void> value, std::size_t bytes) {
  if (bytes > shard_bytes_) return;
  std::list<Entry> given_up;  // destroyed after the lock is released
  Shard& s = shard(key);
  const std::lock_guard lock(s.mutex);
  if (s.index.contains(key)) return;
  while (s.bytes + bytes > shard_bytes_) {
    s.bytes -= s.entries.back().bytes;
    s.index.erase(s.entries.back().key);
    given_up.splice(given_up.begin(), s.entries, std::prev(s.entries.end()));
  }
  s.entries.push_front({key, std::move(value), bytes});
  s.index.emplace(key, s.entries.begin());
  s.bytes += bytes;
}

void BlockCache::erase(std::uint64_t key) {
  Shard& s = shard(key);
  const std::lock_guard lock(s.mutex);
  const auto found = s.index.find(key);
  if (found == s.index.end()) return;
  s.bytes -= found->second->bytes;
  s.entries.erase(found->second);
  s.index.erase(found);
}

std::uint64_t BlockCache::bytes() {
  std::uint64_t sum = 0;
  for (Shard& s : shards_) {
    const std::lock_guard lock(s.mutex);
    sum += s.bytes;
  }
  return sum;
}

}  // namespace itin
