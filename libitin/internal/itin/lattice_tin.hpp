// A triangulation all of whose triangles are halves of the cells of one square lattice, as a raster's are. Its posts
// and, where a cell is not whole, one byte per cell say it all, so that no triangle is listed.
//
//   if (const auto lattice = triangulate_lattice(store, window, ThemeChoice::none(), 100'000'000, progress))
//     for (std::uint32_t t : ...) use(lattice->corners(t));
//
// It takes little more than 4 bytes per post, where a Tin takes 38, and a fraction of the time. Columns count eastwards
// and rows southwards. Cell (c, r) lies between posts (c, r) and (c + 1, r + 1). The first and the last cells of every
// row and column are bare. Cells are kept in square tiles. Tiles without ground take no memory; nor do heights that
// have not been read yet (lattice_reader.hpp): in such tiles it is only known where ground is.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/precondition.hpp>
#include <itin/progress.hpp>
#include <itin/theme.hpp>
#include <itin/tin.hpp>
#include <itin/window.hpp>

namespace itin {

class Store;

/// A position in the plane, grid units.
struct GridPlace {
  std::int32_t x = 0, y = 0;
  friend auto operator<=>(const GridPlace&, const GridPlace&) = default;
};

/// A piece of the rim of a surface; the surface lies to its left.
struct RimEdge {
  GridPlace from, to;
};

struct LatticeTin {
  Grid grid;
  std::int32_t west = 0, north = 0;  ///< where post (0, 0) is, grid units
  std::int32_t spacing = 1;          ///< grid units
  std::uint32_t columns = 0, rows = 0;
  std::int32_t lowest = 0, highest = 0;  ///< no height is lower or higher; grid units
  RetrievalStatistics statistics;

  /// The triangles, named by the corner of the cell at which they have their right angle. A cell has two that share a
  /// diagonal, or one, or none.
  enum Half : std::uint8_t { kSouthWest = 1, kNorthEast = 2, kNorthWest = 4, kSouthEast = 8 };
  static constexpr std::uint8_t kFalling = kSouthWest | kNorthEast;  ///< the whole cell, its diagonal from north-west
  static constexpr std::uint8_t kRising = kNorthWest | kSouthEast;   ///< the whole cell, its diagonal from south-west
  /// The western and the eastern triangle of a cell, whichever diagonal it has.
  static constexpr std::uint8_t kFirst = kSouthWest | kNorthWest, kSecond = kNorthEast | kSouthEast;

  static constexpr std::uint32_t kSide = 64;          ///< the side of a tile, cells
  static constexpr std::uint32_t kPosts = kSide + 1;  ///< posts along it
  static constexpr std::uint32_t kCells = kSide * kSide;
  enum class Ground : std::uint8_t { kNone, kPartly, kWhole };
  struct Tile {
    Ground ground = Ground::kNone;                                       ///< kWhole: every cell is kFalling
    std::unique_ptr<std::array<std::uint8_t, kCells>> halves;            ///< by cell, as bits of Half, where kPartly
    std::unique_ptr<std::array<std::int32_t, kPosts * kPosts>> heights;  ///< by post; null where they are not read
  };
  std::vector<Tile> tiles;  ///< row by row; those at the eastern and southern ends reach beyond the lattice

  // Cells are numbered tile by tile, row by row. There are fewer than 2^31, so that triangles have numbers as well.
  static constexpr std::uint32_t kMostTiles = (std::uint32_t{1} << 31) / kCells - 1;
  static constexpr std::uint32_t kBits = 6;
  static_assert(kSide == 1U << kBits);
  std::uint32_t tile_columns() const { return (columns + kSide - 1) >> kBits; }
  std::uint32_t tile_rows() const { return (rows + kSide - 1) >> kBits; }
  std::uint32_t tile_of(std::uint32_t column, std::uint32_t row) const {
    return (row >> kBits) * tile_columns() + (column >> kBits);
  }
  std::uint32_t cell(std::uint32_t column, std::uint32_t row) const {
    return tile_of(column, row) << 2 * kBits | (row % kSide) << kBits | column % kSide;
  }
  std::uint32_t column_of(std::uint32_t cell) const {
    return (cell >> 2 * kBits) % tile_columns() << kBits | cell % kSide;
  }
  std::uint32_t row_of(std::uint32_t cell) const {
    return (cell >> 2 * kBits) / tile_columns() << kBits | (cell >> kBits) % kSide;
  }

  std::int32_t x(std::uint32_t column) const { return west + static_cast<std::int32_t>(column) * spacing; }
  std::int32_t y(std::uint32_t row) const { return north - static_cast<std::int32_t>(row) * spacing; }

  std::uint8_t halves(std::uint32_t cell) const {
    const Tile& tile = tiles[cell >> 2 * kBits];
    return tile.ground == Ground::kWhole  ? kFalling
           : tile.ground == Ground::kNone ? std::uint8_t{0}
                                          : (*tile.halves)[cell % kCells];
  }
  static bool whole(std::uint8_t halves) { return halves == kFalling || halves == kRising; }
  bool read(std::uint32_t cell) const { return tiles[cell >> 2 * kBits].heights != nullptr; }
  /// Returns the cell's north-western post, followed by its north-eastern one; the southern ones come kPosts later.
  /// Precondition: read(cell).
  const std::int32_t* posts(std::uint32_t cell) const {
    ITIN_PRECONDITION(read(cell));
    const std::uint32_t in_tile = cell % kCells;
    return tiles[cell >> 2 * kBits].heights->data() + in_tile + (in_tile >> kBits);
  }

  /// Returns the height of the post at a position, grid units, where a post of a whole cell is there, and read.
  std::optional<std::int32_t> post_at(double at_x, double at_y) const {
    const double east = at_x - west, south = north - at_y, a_unit = 1.0 / spacing;
    if (!(east >= spacing && south >= spacing && east < 1.0 * spacing * columns && south < 1.0 * spacing * rows))
      return std::nullopt;
    // These are whole numbers but for rounding, which the quarter absorbs.
    const auto c = static_cast<std::uint32_t>(east * a_unit + 0.25),
               r = static_cast<std::uint32_t>(south * a_unit + 0.25);
    if (1.0 * c * spacing != east || 1.0 * r * spacing != south) return std::nullopt;
    const std::uint32_t before = cell(c, r);
    if (read(before) && whole(halves(before))) return posts(before)[0];
    const std::uint32_t beyond = cell(c - 1, r - 1);
    if (read(beyond) && whole(halves(beyond))) return posts(beyond)[kPosts + 1];
    return std::nullopt;
  }

  /// Calls visit(triangle) with the number of each of a cell's triangles, until one call returns false. Returns whether
  /// none did.
  template <class Visit>
  bool for_each_triangle(std::uint32_t cell, const Visit& visit) const {
    const std::uint8_t there = halves(cell);
    return ((there & kFirst) == 0 || visit(2 * cell)) && ((there & kSecond) == 0 || visit(2 * cell + 1));
  }
  /// Returns the corners of a triangle, counterclockwise. The western triangle of a cell has twice the cell's number,
  /// the eastern one the next number. Precondition: read.
  std::array<GridPoint, 3> corners(std::uint32_t triangle) const {
    const std::int32_t* const height = posts(triangle / 2);
    return corners(triangle, {height[0], height[1], height[kPosts], height[kPosts + 1]});
  }
  /// Returns the corners in the plane, at height 0.
  std::array<GridPoint, 3> outline(std::uint32_t triangle) const { return corners(triangle, {}); }
  std::uint64_t triangle_count() const;

  /// Returns where the surface ends, as edges between neighbouring posts.
  std::vector<RimEdge> rim() const;

  /// Returns the smallest box of all triangles, metres.
  Box bounds() const;

  /// Lists the triangles one by one, in the order of a Tin's; without sources. Precondition: all tiles are read.
  Tin tin() const;

  // The following functions fill it.
  /// Makes room for the heights of a tile.
  void make_heights(std::uint32_t tile) {
    tiles[tile].heights = std::make_unique<std::array<std::int32_t, kPosts * kPosts>>();
  }
  /// Calls visit(tile, place in its heights) for the up to four tiles that a post belongs to.
  template <class Visit>
  void for_each_tile_of(std::uint32_t column, std::uint32_t row, const Visit& visit) const;
  /// Classifies the ground of a tile whose halves are set, and drops the halves where the class says it all.
  void classify_tile(std::uint32_t tile);

 private:
  struct Square {
    std::int32_t nw = 0, ne = 0, sw = 0, se = 0;
  };
  std::array<GridPoint, 3> corners(std::uint32_t triangle, const Square& height) const;
};

inline std::array<GridPoint, 3> LatticeTin::corners(std::uint32_t triangle, const Square& height) const {
  const std::uint32_t cell = triangle / 2;
  const std::int32_t left = x(column_of(cell)), top = y(row_of(cell)), right = left + spacing, bottom = top - spacing;
  const GridPoint sw{left, bottom, height.sw}, se{right, bottom, height.se}, ne{right, top, height.ne},
      nw{left, top, height.nw};
  const bool second = triangle % 2 != 0;
  if ((halves(cell) & kRising) != 0) return second ? std::array{sw, se, ne} : std::array{sw, ne, nw};
  return second ? std::array{se, ne, nw} : std::array{sw, se, nw};
}

template <class Visit>
void LatticeTin::for_each_tile_of(std::uint32_t column, std::uint32_t row, const Visit& visit) const {
  const std::uint32_t tile = tile_of(column, row), c = column % kSide, r = row % kSide;
  visit(tile, r * kPosts + c);
  const bool west_edge = c == 0 && column > 0, north_edge = r == 0 && row > 0;
  if (west_edge) visit(tile - 1, r * kPosts + kSide);
  if (north_edge) visit(tile - tile_columns(), kSide * kPosts + c);
  if (west_edge && north_edge) visit(tile - tile_columns() - 1, kSide * kPosts + kSide);
}

/// Returns the triangles of triangulate() at tolerance 0, if each is half a cell of the lattice on which the terrain's
/// posts lie, no line of a theme comes between them and no feature stands on them. Otherwise, and where the lattice
/// would have more than `most_posts` or be mostly empty, returns nothing: most often the first block read tells. Cost:
/// reads each block of the window once; O(posts). Throws as triangulate() does.
std::optional<LatticeTin> triangulate_lattice(const Store& store, const Window& window, const ThemeChoice& themes,
                                              std::uint64_t most_posts, Progress& progress);

/// Returns the lattice that a Tin is. Nothing where it is none, or covers so little of a lattice that this would be
/// mostly empty. O(n); most often the first few triangles already show that it is none.
std::optional<LatticeTin> lattice_of(const Tin& tin);

}  // namespace itin
