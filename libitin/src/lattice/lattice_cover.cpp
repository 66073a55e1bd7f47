#include "lattice/lattice_cover.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

#include <itin/parallel.hpp>
#include <itin/sort_unique.hpp>

#include "geometry/lattice_edges.hpp"

namespace itin {

namespace {

constexpr std::uint32_t kSide = LatticeTin::kSide;
constexpr std::uint32_t kBlock = 8;  ///< side, in cells, of the blocks for which the window is asked where it has part
                                     ///< of a tile

/// Further bits of a cell, beside those of LatticeTin::Half: whether its halves are known, and whether the window may
/// leave out parts of the cell.
constexpr std::uint8_t kKnown = 0x80, kCut = 0x40;
constexpr std::uint8_t kHalves = LatticeTin::kFalling | LatticeTin::kRising;

/// The halves of a cell that has these posts, as bits: north-west 1, north-east 2, south-west 4, south-east 8.
constexpr std::array<std::uint8_t, 16> kHalvesOfPosts = [] {
  std::array<std::uint8_t, 16> halves{};
  halves[1 | 4 | 8] = LatticeTin::kSouthWest;
  halves[1 | 2 | 8] = LatticeTin::kNorthEast;
  halves[1 | 2 | 4] = LatticeTin::kNorthWest;
  halves[2 | 4 | 8] = LatticeTin::kSouthEast;
  halves[15] = LatticeTin::kFalling;
  return halves;
}();

}  // namespace

LatticeCover::LatticeCover(LatticeTin& lattice, const GridWindow& window, bool everything)
    : lattice_(lattice),
      window_(window),
      everything_(everything),
      reach_(lattice.tiles.size()),
      posts_(lattice.tiles.size()) {
  const std::uint32_t columns = lattice.tile_columns();
  parallel_for(lattice.tile_rows(), [&](std::size_t row) {
    for (std::uint32_t column = 0; column < columns; ++column)
      reach_[row * columns + column] =
          reach_of(std::int64_t{column} * kSide, static_cast<std::int64_t>(row) * kSide, kSide);
  });
  for (std::uint32_t t = 0; t < reach_.size(); ++t) {
    if (!reaches(t)) continue;
    const std::uint32_t east = t % columns + 1 < columns ? 1 : 0, south = t + columns < reach_.size() ? columns : 0;
    for (const std::uint32_t with_posts : {t, t + east, t + south, t + south + east})
      if (!posts_[with_posts]) posts_[with_posts] = std::make_unique<Posts>();
  }
}

std::uint64_t LatticeCover::most_posts() const {
  std::uint64_t most = 0;
  for (std::uint32_t t = 0; t < reach_.size(); ++t) {
    if (!reaches(t)) continue;
    const std::uint32_t first = t * LatticeTin::kCells;
    most += std::uint64_t{std::min(kSide, lattice_.columns - lattice_.column_of(first))} *
            std::min(kSide, lattice_.rows - lattice_.row_of(first));
  }
  return most;
}

void LatticeCover::add(std::uint32_t column, std::uint32_t row) {
  if (Posts* const posts = posts_[lattice_.tile_of(column, row)].get())
    std::atomic_ref((*posts)[row % kSide]).fetch_or(Word{1} << column % kSide, std::memory_order_relaxed);
}

/// Calls visit(posts of a tile, row within it, mask) for every row of a tile with some of the places. The posts are
/// null where they are out of reach.
template <class Visit>
void LatticeCover::for_each_word(const PlaceBox& places, const Visit& visit) const {
  for (std::uint32_t row = places.north; row <= places.south; ++row) {
    for (std::uint32_t column = places.west; column <= places.east; column = (column / kSide + 1) * kSide) {
      const std::uint32_t count = std::min(places.east - column + 1, kSide - column % kSide);
      const Word mask = (count == kSide ? ~Word{0} : (Word{1} << count) - 1) << column % kSide;
      visit(posts_[lattice_.tile_of(column, row)].get(), row % kSide, mask);
    }
  }
}

std::uint64_t LatticeCover::lacks(const PlaceBox& places) const {
  std::uint64_t count = 0;
  bool in_reach = true;
  for_each_word(places, [&](Posts* posts, std::uint32_t row, Word mask) {
    in_reach = in_reach && posts != nullptr;
    if (in_reach)
      count += static_cast<std::uint64_t>(
          std::popcount(mask & ~std::atomic_ref((*posts)[row]).load(std::memory_order_relaxed)));
  });
  return in_reach ? count : 0;
}

void LatticeCover::fill(const PlaceBox& places) {
  for_each_word(places, [](Posts* posts, std::uint32_t row, Word mask) {
    if (posts != nullptr) std::atomic_ref((*posts)[row]).fetch_or(mask, std::memory_order_relaxed);
  });
}

bool LatticeCover::near_known(std::uint32_t column, std::uint32_t row) const {
  for (const int dx : {-1, 0, 1})
    for (const int dy : {-1, 0, 1})
      if (known(std::int64_t{column} + dx, std::int64_t{row} + dy, everything_ ? Reach::kWhole : Reach::kPartly))
        return true;
  return false;
}

GridBox LatticeCover::box_of(std::int64_t column, std::int64_t row, std::int64_t end_column,
                             std::int64_t end_row) const {
  const auto x = [&](std::int64_t c) { return lattice_.x(static_cast<std::uint32_t>(c)); };
  const auto y = [&](std::int64_t r) { return lattice_.y(static_cast<std::uint32_t>(r)); };
  return {x(column), y(end_row), x(end_column), y(row)};
}

/// Returns how far a square of cells lies within reach.
LatticeCover::Reach LatticeCover::reach_of(std::int64_t column, std::int64_t row, std::int64_t side) const {
  if (everything_) return Reach::kWhole;
  const GridBox box = box_of(column, row, std::min<std::int64_t>(column + side, lattice_.columns),
                             std::min<std::int64_t>(row + side, lattice_.rows));
  return window_.holds(box) ? Reach::kWhole : window_.meets(box) ? Reach::kPartly : Reach::kNone;
}

/// Tells whether all posts of the cell are known, given the reach of an area that holds the cell.
bool LatticeCover::known(std::int64_t column, std::int64_t row, Reach reach) const {
  if (column < 0 || row < 0 || column + 1 >= lattice_.columns || row + 1 >= lattice_.rows) return false;
  return reach == Reach::kWhole || (reach == Reach::kPartly && window_.meets(box_of(column, row, column + 1, row + 1)));
}

/// Returns a row of posts; also the row below a tile's last one, whose posts are the next tile's.
LatticeCover::Word LatticeCover::posts(std::uint32_t tile_column, std::uint32_t tile_row, std::uint32_t row) const {
  if (row == kSide) ++tile_row;
  if (tile_column >= lattice_.tile_columns() || tile_row >= lattice_.tile_rows()) return 0;
  return (*posts_[tile_row * lattice_.tile_columns() + tile_column])[row % kSide];
}

void LatticeCover::join() {
  parallel_for(reach_.size(), [&](std::size_t t) {
    if (reaches(static_cast<std::uint32_t>(t))) join(static_cast<std::uint32_t>(t));
  });
  posts_.clear();
}

void LatticeCover::join(std::uint32_t tile) {
  const std::uint32_t tile_column = tile % lattice_.tile_columns(), tile_row = tile / lattice_.tile_columns();
  std::array<Word, kSide + 1> posts, next;  // `next`: from the second column on
  bool all = reach_[tile] == Reach::kWhole;
  for (std::uint32_t row = 0; row <= kSide; ++row) {
    posts[row] = this->posts(tile_column, tile_row, row);
    next[row] = posts[row] >> 1 | this->posts(tile_column + 1, tile_row, row) << (kSide - 1);
    all = all && (posts[row] & next[row]) == ~Word{0};
  }
  if (all) {
    lattice_.tiles[tile].ground = LatticeTin::Ground::kWhole;
    return;
  }
  auto halves = std::make_unique<std::array<std::uint8_t, LatticeTin::kCells>>();
  for (std::uint32_t first_row = 0; first_row < kSide; first_row += kBlock) {
    for (std::uint32_t first_column = 0; first_column < kSide; first_column += kBlock) {
      const std::int64_t west = std::int64_t{tile_column} * kSide + first_column,
                         north = std::int64_t{tile_row} * kSide + first_row;
      const Reach reach = reach_[tile] == Reach::kWhole ? Reach::kWhole : reach_of(west, north, kBlock);
      if (reach == Reach::kNone) continue;
      const std::uint8_t cut = reach == Reach::kWhole ? 0 : kCut;
      for (std::uint32_t row = first_row; row < first_row + kBlock; ++row) {
        for (std::uint32_t column = first_column; column < first_column + kBlock; ++column) {
          if (!known(tile_column * kSide + column, tile_row * kSide + row, reach)) continue;
          const auto bit = [&](Word word) { return static_cast<std::uint32_t>(word >> column & 1); };
          const std::uint32_t there =
              bit(posts[row]) | bit(next[row]) << 1 | bit(posts[row + 1]) << 2 | bit(next[row + 1]) << 3;
          (*halves)[row * kSide + column] = static_cast<std::uint8_t>(kKnown | cut | kHalvesOfPosts[there]);
        }
      }
    }
  }
  lattice_.tiles[tile].halves = std::move(halves);
  lattice_.tiles[tile].ground = LatticeTin::Ground::kPartly;
}

/// Returns the halves that a cell has; negative where they are not known.
int LatticeCover::halves(std::int64_t column, std::int64_t row) const {
  if (column < 0 || row < 0 || column + 1 >= lattice_.columns || row + 1 >= lattice_.rows) return -1;
  const std::uint32_t cell = lattice_.cell(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
  if (lattice_.tiles[cell / LatticeTin::kCells].ground == LatticeTin::Ground::kWhole) return LatticeTin::kFalling;
  const std::uint8_t there = lattice_.halves(cell);
  return (there & kKnown) != 0 ? there & kHalves : -1;
}

LatticeCover::Edge LatticeCover::edge(std::int64_t column, std::int64_t row, std::size_t direction) const {
  return {static_cast<std::uint64_t>(row) * lattice_.columns + static_cast<std::uint64_t>(column), direction};
}

/// Returns the edges of known halves that are known to have no half beyond them.
std::vector<LatticeCover::Edge> LatticeCover::edges_without_twin() const {
  std::vector<std::vector<Edge>> of_tiles(lattice_.tiles.size());
  parallel_for(of_tiles.size(), [&](std::size_t tile) {
    for_each_open_edge_of(
        lattice_, static_cast<std::uint32_t>(tile),
        [&](std::int64_t column, std::int64_t row) { return halves(column, row); },
        [&](std::int64_t column, std::int64_t row, std::size_t direction) {
          of_tiles[tile].push_back(edge(column, row, direction));
        });
  });
  std::vector<Edge> edges;
  for (const std::vector<Edge>& some : of_tiles) edges.insert(edges.end(), some.begin(), some.end());
  return edges;
}

/// Adds the outline's edges between known cells. Returns false where the outline contradicts the halves there.
bool LatticeCover::add_edges_of(const Segment& s, std::vector<Edge>& edges) const {
  const std::int64_t spacing = lattice_.spacing, dx = std::int64_t{s.bx} - s.ax, dy = std::int64_t{s.by} - s.ay;
  const std::int64_t east = std::int64_t{s.ax} - lattice_.west, south = std::int64_t{lattice_.north} - s.ay;
  if (east % spacing != 0 || south % spacing != 0 || dx % spacing != 0 || dy % spacing != 0) return false;
  const std::int64_t length = std::max(std::abs(dx), std::abs(dy));
  if ((dx != 0 && std::abs(dx) != length) || (dy != 0 && std::abs(dy) != length)) return false;
  const auto sign = [](std::int64_t v) { return (v > 0) - (v < 0); };
  const auto direction = static_cast<std::size_t>(
      std::find_if(kLatticeSteps.begin(), kLatticeSteps.end(),
                   [&](const LatticeStep& t) { return t.dx == sign(dx) && t.dy == sign(dy); }) -
      kLatticeSteps.begin());
  const LatticeStep& step = kLatticeSteps[direction];
  for (std::int64_t i = 0; i < length / spacing; ++i) {
    const std::int64_t column = east / spacing + i * step.dx, row = south / spacing - i * step.dy;
    const int left = halves(column + step.left_dx, row + step.left_dy),
              right = halves(column + step.right_dx, row + step.right_dy);
    if (left >= 0 && (left & step.left_halves) == 0) return false;
    if (right > 0 && (right & step.right_halves) != 0) return false;
    if (left >= 0 && right >= 0) edges.push_back(edge(column, row, direction));
  }
  return true;
}

bool LatticeCover::ends_at(std::span<const Segment> segments) const {
  std::vector<Edge> outline;
  if (!std::all_of(segments.begin(), segments.end(), [&](const Segment& s) { return add_edges_of(s, outline); }))
    return false;
  sort_unique(outline);
  std::vector<Edge> edges = edges_without_twin();
  std::sort(edges.begin(), edges.end());
  return edges == outline;
}

bool LatticeCover::any() const {
  return std::any_of(lattice_.tiles.begin(), lattice_.tiles.end(), [](const LatticeTin::Tile& tile) {
    const auto there = [](std::uint8_t halves) { return (halves & kHalves) != 0; };
    return tile.ground == LatticeTin::Ground::kWhole ||
           (tile.halves && std::any_of(tile.halves->begin(), tile.halves->end(), there));
  });
}

bool LatticeCover::reaches(const GridWindow& part) const {
  const auto number = [&](std::int64_t units, std::uint32_t count) {
    return std::clamp<std::int64_t>(units / lattice_.spacing, 0, std::int64_t{count} - 2);
  };
  const GridBox box = part.bounds();
  const std::int64_t first = number(std::int64_t{box.xmin} - lattice_.west, lattice_.columns),
                     last = number(std::int64_t{box.xmax} - lattice_.west, lattice_.columns),
                     bottom = number(std::int64_t{lattice_.north} - box.ymin, lattice_.rows);
  bool met = false;
  for (std::int64_t row = number(std::int64_t{lattice_.north} - box.ymax, lattice_.rows); row <= bottom; ++row) {
    for (std::int64_t column = first; column <= last; ++column) {
      if (!part.meets(box_of(column, row, column + 1, row + 1))) continue;
      met = true;
      if (halves(column, row) > 0) return true;
    }
  }
  return !met;
}

void LatticeCover::cut() {
  parallel_for(lattice_.tiles.size(), [&](std::size_t tile) {
    if (lattice_.tiles[tile].ground == LatticeTin::Ground::kPartly) cut(static_cast<std::uint32_t>(tile));
  });
}

void LatticeCover::cut(std::uint32_t tile) {
  for (std::uint32_t i = 0; i < LatticeTin::kCells; ++i) {
    std::uint8_t& halves = (*lattice_.tiles[tile].halves)[i];
    const bool check = (halves & kCut) != 0;
    halves &= kHalves;
    if (!check) continue;
    std::uint8_t out = 0;
    lattice_.for_each_triangle(tile * LatticeTin::kCells + i, [&](std::uint32_t t) {
      const auto [a, b, c] = lattice_.outline(t);
      if (!window_.meets(a, b, c)) out |= t % 2 == 0 ? LatticeTin::kFirst : LatticeTin::kSecond;
      return true;
    });
    halves &= static_cast<std::uint8_t>(~out);
  }
  lattice_.classify_tile(tile);
}

}  // namespace itin
