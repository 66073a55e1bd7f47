// A triangulation all of whose triangles are halves of the cells of one square lattice, as a raster's are: its posts
// and a byte a cell say it all, so that no triangle is listed.
//
//   if (const auto lattice = triangulate_lattice(store, window, ThemeChoice::none(), 100'000'000, progress))
//     for (std::uint32_t t : ...) use(lattice->corners(t));
//
// 5 bytes a post, where a Tin takes 38, and a fraction of the time. Columns count eastwards and rows southwards. Cell
// (c, r) lies between posts (c, r) and (c + 1, r + 1), and has the number of its north-western post. The first and the
// last cells of every row and column are bare.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/theme.hpp>
#include <itin/tin.hpp>
#include <itin/window.hpp>

namespace itin {

class Store;

/// A piece of the rim of a surface, which lies to its left.
struct RimEdge {
  GridPoint from, to;
};

struct LatticeTin {
  Grid grid;
  std::int32_t west = 0, north = 0;  ///< of post (0, 0), grid units
  std::int32_t spacing = 1;          ///< grid units
  std::uint32_t columns = 0, rows = 0;
  std::vector<std::int32_t> heights;  ///< of posts, grid units; kNoPost where none is
  std::vector<std::uint8_t> halves;   ///< of cells: those triangles that are there, as bits
  RetrievalStatistics statistics;

  static constexpr std::int32_t kNoPost = std::numeric_limits<std::int32_t>::min();
  /// Triangles by the corner of the cell at which they have their right angle. A cell has two that share a diagonal,
  /// or one, or none.
  enum Half : std::uint8_t { kSouthWest = 1, kNorthEast = 2, kNorthWest = 4, kSouthEast = 8 };
  static constexpr std::uint8_t kFalling = kSouthWest | kNorthEast;  ///< the whole cell, its diagonal from north-west
  static constexpr std::uint8_t kRising = kNorthWest | kSouthEast;   ///< the whole cell, its diagonal from south-west
  /// Of the two triangles of a cell, whichever its diagonal, the western and the eastern one.
  static constexpr std::uint8_t kFirst = kSouthWest | kNorthWest, kSecond = kNorthEast | kSouthEast;
  bool whole(std::size_t cell) const { return halves[cell] == kFalling || halves[cell] == kRising; }

  std::size_t index(std::uint32_t column, std::uint32_t row) const { return std::size_t{row} * columns + column; }
  std::int32_t x(std::uint32_t column) const { return west + static_cast<std::int32_t>(column) * spacing; }
  std::int32_t y(std::uint32_t row) const { return north - static_cast<std::int32_t>(row) * spacing; }
  GridPoint post(std::uint32_t column, std::uint32_t row) const {
    return {x(column), y(row), heights[index(column, row)]};
  }

  /// The height of the post at a position, grid units, where that is one of a whole cell's.
  std::optional<std::int32_t> post_at(double at_x, double at_y) const {
    const double east = at_x - west, south = north - at_y, a_unit = 1.0 / spacing;
    if (!(east >= spacing && south >= spacing && east < 1.0 * spacing * columns && south < 1.0 * spacing * rows))
      return std::nullopt;
    // Whole numbers but for rounding, which the quarter swallows.
    const auto c = static_cast<std::uint32_t>(east * a_unit + 0.25),
               r = static_cast<std::uint32_t>(south * a_unit + 0.25);
    if (1.0 * c * spacing != east || 1.0 * r * spacing != south) return std::nullopt;
    const std::size_t post = index(c, r);
    if (!whole(post) && !whole(post - columns - 1)) return std::nullopt;
    return heights[post];
  }

  /// Calls visit(triangle) for each of a cell's triangles, by a number of its own, until one call returns false.
  /// Returns whether none did.
  template <class Visit>
  bool for_each_triangle(std::size_t cell, const Visit& visit) const {
    const std::uint8_t there = halves[cell];
    const auto first = static_cast<std::uint32_t>(2 * cell);
    return ((there & kFirst) == 0 || visit(first)) && ((there & kSecond) == 0 || visit(first + 1));
  }
  /// Of a triangle, counterclockwise. The western one of a cell has the number of the cell, doubled, the eastern one
  /// the next.
  std::array<GridPoint, 3> corners(std::uint32_t triangle) const;
  std::size_t triangle_count() const;

  /// Where the surface ends, between neighbouring posts.
  std::vector<RimEdge> rim() const;

  /// The smallest box of all triangles, metres.
  Box bounds() const;

  /// The same triangles one by one, in the order of a Tin's; without sources.
  Tin tin() const;
};

inline std::array<GridPoint, 3> LatticeTin::corners(std::uint32_t triangle) const {
  const std::uint32_t cell = triangle / 2, row = cell / columns, column = cell - row * columns;
  const std::int32_t left = x(column), top = y(row), right = left + spacing, bottom = top - spacing;
  const std::int32_t* const upper = heights.data() + cell;
  const std::int32_t* const lower = upper + columns;
  const GridPoint sw{left, bottom, lower[0]}, se{right, bottom, lower[1]}, ne{right, top, upper[1]},
      nw{left, top, upper[0]};
  const bool second = triangle % 2 != 0;
  if ((halves[cell] & kRising) != 0) return second ? std::array{sw, se, ne} : std::array{sw, ne, nw};
  return second ? std::array{se, ne, nw} : std::array{sw, se, nw};
}

/// The triangles of triangulate() at tolerance 0, where every one of them is half a cell of the lattice on which the
/// terrain's posts lie, no line of a theme comes between them and no feature stands on them. Nothing elsewhere, or
/// where the lattice would have more than `most_posts` or be mostly empty: most often the first block read tells. Cost:
/// each block of the window once; O(posts). Throws as triangulate() does.
std::optional<LatticeTin> triangulate_lattice(const Store& store, const Window& window, const ThemeChoice& themes,
                                              std::uint64_t most_posts, Progress& progress);

/// Whether that may be one: what a few blocks tell.
bool looks_like_lattice(const Store& store, const Window& window, const ThemeChoice& themes, std::uint64_t most_posts);

/// A Tin that is one. Nothing where it is not, or covers so little of a lattice that that would be mostly empty. O(n);
/// what is none is most often found out by the first few triangles.
std::optional<LatticeTin> lattice_of(const Tin& tin);

}  // namespace itin
