// Finds the cells of a lattice that are ground within a window, from the posts' places, and proves that nothing else
// is.
//
// The circle about a cell has no other place of the lattice in or on it. Suppose that three or four of a cell's posts
// are there and all posts lie on the lattice. Then the halves that they make are triangles of the Delaunay
// triangulation, and of the constrained one where no segment comes between. The coverage outline, which bounds ground
// everywhere, tells which of them are ground. Suppose that it is made of edges of cells or diagonals, and that the
// edges without a twin of all these halves are exactly the outline's, with the halves on the side of the ground. Then
// no other ground is within reach from the halves, and no ground of their own is missing.
//
//   LatticeCover cover(lattice, window, false);
//   for (post : posts) cover.add(column, row);
//   cover.join();
//   if (cover.ends_at(segments)) cover.cut();         // and the lattice knows its ground
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <itin/lattice_tin.hpp>

#include "lattice/lattice_frame.hpp"
#include "store/codec/point_index.hpp"
#include "triangulate/region/grid_window.hpp"

namespace itin {

class LatticeCover {
 public:
  /// Takes a lattice laid out with its tiles, which have no ground yet. `everything`: covers the whole lattice, and not
  /// only the part that meets the window. Both must outlive this.
  LatticeCover(LatticeTin& lattice, const GridWindow& window, bool everything);

  /// Tells whether ground may be in a tile.
  bool reaches(std::uint32_t tile) const { return reach_[tile] != Reach::kNone; }
  /// Returns the most posts that the lattice may have within reach.
  std::uint64_t most_posts() const;

  /// Adds a post. Safe for concurrent use.
  void add(std::uint32_t column, std::uint32_t row);
  /// Returns how many of these places have no post yet; 0 where some of them are out of reach. Neither this nor fill()
  /// is safe while posts are added to the same places.
  std::uint64_t lacks(const PlaceBox& places) const;
  /// Adds posts at all of these places that are within reach.
  void fill(const PlaceBox& places);
  /// Tells whether a point between posts, to the south-east of this place, may lie in the circle about a known cell.
  bool near_known(std::uint32_t column, std::uint32_t row) const;

  /// Makes cells of the posts, when all have been added.
  void join();
  /// Tells whether the ground ends exactly where these segments of the coverage outline are.
  bool ends_at(std::span<const Segment> outline) const;
  /// Tells whether there is ground.
  bool any() const;
  /// Tells whether a part of the window has ground, or meets no cell.
  bool reaches(const GridWindow& part) const;
  /// Leaves out the halves that do not meet the window.
  void cut();

 private:
  enum class Reach : std::uint8_t { kNone, kPartly, kWhole };
  using Word = std::uint64_t;  ///< a row of a tile's posts
  using Posts = std::array<Word, LatticeTin::kSide>;
  /// An edge of a cell or a diagonal, by its first post and its direction.
  using Edge = std::pair<std::uint64_t, std::size_t>;

  template <class Visit>
  void for_each_word(const PlaceBox& places, const Visit& visit) const;
  GridBox box_of(std::int64_t column, std::int64_t row, std::int64_t end_column, std::int64_t end_row) const;
  Reach reach_of(std::int64_t column, std::int64_t row, std::int64_t side) const;
  bool known(std::int64_t column, std::int64_t row, Reach reach) const;
  Word posts(std::uint32_t tile_column, std::uint32_t tile_row, std::uint32_t row) const;
  void join(std::uint32_t tile);
  int halves(std::int64_t column, std::int64_t row) const;
  Edge edge(std::int64_t column, std::int64_t row, std::size_t direction) const;
  std::vector<Edge> edges_without_twin() const;
  bool add_edges_of(const Segment& s, std::vector<Edge>& edges) const;
  void cut(std::uint32_t tile);

  LatticeTin& lattice_;
  const GridWindow& window_;
  bool everything_;
  std::vector<Reach> reach_;                   ///< one for each tile
  std::vector<std::unique_ptr<Posts>> posts_;  ///< null for tiles without posts of cells within reach
};

}  // namespace itin
