#include "scene/ground_cache.hpp"

namespace itin::viewshed {

namespace {

constexpr std::uint64_t kBytesPerTile = sizeof(TileValues<double>);

}  // namespace

std::uint64_t GroundCache::new_surface() {
  const std::lock_guard lock(mutex_);
  return surfaces_++;
}

GroundCache::Heights GroundCache::get(const Key& key, const std::function<Heights()>& make) {
  if (Heights kept = find(key)) return kept;
  Heights made = make();
  const std::lock_guard lock(mutex_);
  const auto [place, is_new] = places_.try_emplace(key, tiles_.end());
  if (!is_new) return place->second->second;
  tiles_.emplace_front(key, made);
  place->second = tiles_.begin();
  drop_surplus();
  return made;
}

GroundCache::Heights GroundCache::find(const Key& key) {
  const std::lock_guard lock(mutex_);
  const auto place = places_.find(key);
  if (place == places_.end()) return nullptr;
  tiles_.splice(tiles_.begin(), tiles_, place->second);
  return place->second->second;
}

void GroundCache::limit(std::uint64_t most_bytes) {
  const std::lock_guard lock(mutex_);
  most_bytes_ = most_bytes;
  drop_surplus();
}

std::uint64_t GroundCache::bytes() const {
  const std::lock_guard lock(mutex_);
  return tiles_.size() * kBytesPerTile;
}

void GroundCache::drop_surplus() {
  while (tiles_.size() * kBytesPerTile > most_bytes_) {
    places_.erase(tiles_.back().first);
    tiles_.pop_back();
  }
}

}  // namespace itin::viewshed
