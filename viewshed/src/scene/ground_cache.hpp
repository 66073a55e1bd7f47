// The heights of tiles of cells, as many of those used last as a memory holds.
//
//   GroundCache cache(most_bytes);
//   const GroundCache::Heights heights = cache.get({surface, 50, 50, column, row}, [&] { return measured(); });
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "line/cell_tiles.hpp"

namespace itin::viewshed {

/// Safe for concurrent use.
class GroundCache {
 public:
  explicit GroundCache(std::uint64_t most_bytes) : most_bytes_(most_bytes) {}

  /// A tile of cells of this size, metres, whose western and southern edges are multiples of its own size.
  struct Key {
    std::uint64_t surface = 0;
    double cell_width = 0, cell_height = 0;
    std::int64_t column = 0, row = 0;  ///< in sizes of a tile, eastwards and northwards
    friend auto operator<=>(const Key&, const Key&) = default;
  };
  using Heights = std::shared_ptr<const TileValues<double>>;

  /// Returns a number for a surface whose tiles are about to be kept.
  std::uint64_t new_surface();
  /// Returns what is kept of a tile, or makes it. Two threads may both make a tile; they must make the same.
  Heights get(const Key& key, const std::function<Heights()>& make);

  /// Keeps no more than this from now on.
  void limit(std::uint64_t most_bytes);
  std::uint64_t bytes() const;

 private:
  using Tiles = std::list<std::pair<Key, Heights>>;
  Heights find(const Key& key);
  void drop_surplus();

  mutable std::mutex mutex_;
  std::uint64_t most_bytes_;
  std::uint64_t surfaces_ = 0;
  Tiles tiles_;  ///< the one used last first
  std::map<Key, Tiles::iterator> places_;
};

}  // namespace itin::viewshed
