// The ground cut into square tiles, and sets of tiles that lines pass over.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <itin/window.hpp>

#include "line/set_bits.hpp"

namespace itin::viewshed {

class TileSet {
 public:
  explicit TileSet(std::size_t count = 0) : words_((count + 63) / 64) {}
  void add(std::size_t tile) { words_[tile / 64] |= std::uint64_t{1} << (tile % 64); }
  bool contains(std::size_t tile) const { return (words_[tile / 64] >> (tile % 64) & 1) != 0; }
  bool empty() const;
  TileSet& operator|=(const TileSet& other);
  TileSet& operator&=(const TileSet& other);
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t w = 0; w < words_.size(); ++w) for_each_bit(words_[w], [&](unsigned bit) { visit(64 * w + bit); });
  }

 private:
  std::vector<std::uint64_t> words_;
};

class GroundTiles {
 public:
  /// Cuts the box into square tiles. In a square box each has about `points_of_tile` points of the level's surface. A
  /// tile has more where one side of the box is longer than the other, for the longer side alone decides the size, and
  /// where the longer side would have over 160 tiles.
  GroundTiles(const Store& store, int level, const Box& box, double points_of_tile = 512);

  std::size_t count() const { return grid_.cell_count(); }
  Box box(std::size_t tile) const;
  /// Returns about how many points of that surface lie in a tile, or in some tiles.
  std::uint64_t points(std::size_t tile) const { return points_[tile]; }
  std::uint64_t points(const TileSet& tiles) const;
  /// Returns the tiles for whose box a test holds; all threads run the test.
  TileSet those(const std::function<bool(const Box&)>& test) const;
  /// Adds every tile that the line between two positions meets, or passes within a metre and the grid's resolution.
  void add_line(Point2 from, Point2 to, TileSet& tiles) const;
  /// Adds what add_line() adds for lines from a position to every place of a box, and perhaps tiles between these
  /// lines.
  void add_lines(Point2 from, const Box& to, TileSet& tiles) const;
  /// Returns the union of the tiles.
  Window window(const TileSet& tiles) const;

 private:
  template <class Visit>
  void for_each_column(Point2 from, Point2 to, const Visit& visit) const;

  RasterGrid grid_;
  double margin_;
  std::vector<std::uint32_t> points_;
};

}  // namespace itin::viewshed
