// Reads a window's posts onto their lattice, and proves that nothing but halves of its cells is ground there.
//
// The circle about a cell has no other place of the lattice in or on it. So where three of a cell's posts or all four
// are there and all posts lie on the lattice, the halves that they make are triangles of the Delaunay triangulation,
// and of the constrained one where no segment comes between; which are ground, the coverage outline tells, that bounds
// ground everywhere. If it is made of edges of cells or diagonals, if the edges without a twin of all these halves are
// exactly those of the outline, with the halves on the side of the ground, then no other ground is within reach from
// them, and none of their own is missing.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>

#include <itin/lattice_tin.hpp>
#include <itin/parallel.hpp>
#include <itin/store.hpp>

#include "triangulate/grid_window.hpp"
#include "triangulate/selection.hpp"
#include "triangulate/standing_index.hpp"

namespace itin {

namespace {

/// Of a lattice's posts at least one in so many is there.
constexpr std::uint64_t kEmptiest = 4;
/// So many of the fullest leaves tell the lattice.
constexpr std::size_t kSamples = 8;
constexpr std::uint32_t kBlock = 64;  ///< cells, by which the window is asked
constexpr std::size_t kLeavesATask = 64;

/// Of cells, beside the bits of LatticeTin::Half: whether all their posts have been read, and whether the window may
/// leave out parts of them.
constexpr std::uint8_t kKnown = 0x80, kCut = 0x40;
constexpr std::uint8_t kHalves = LatticeTin::kFalling | LatticeTin::kRising;

/// The halves that are there by which of a cell's posts are: north-west 1, north-east 2, south-west 4, south-east 8.
constexpr std::array<std::uint8_t, 16> kHalvesOfPosts = [] {
  std::array<std::uint8_t, 16> halves{};
  halves[1 | 4 | 8] = LatticeTin::kSouthWest;
  halves[1 | 2 | 8] = LatticeTin::kNorthEast;
  halves[1 | 2 | 4] = LatticeTin::kNorthWest;
  halves[2 | 4 | 8] = LatticeTin::kSouthEast;
  halves[15] = LatticeTin::kFalling;
  return halves;
}();

/// From a post to a neighbour, along the edge of a cell or a diagonal.
struct Step {
  int dx, dy;            ///< eastwards and northwards
  int left_dx, left_dy;  ///< the cell to the left: from the post's own column and row, which is that to its south-east
  std::uint8_t left_halves;  ///< of that cell, those that have the edge
  int right_dx, right_dy;
  std::uint8_t right_halves;
};

constexpr std::uint8_t kSW = LatticeTin::kSouthWest, kNE = LatticeTin::kNorthEast, kNW = LatticeTin::kNorthWest,
                       kSE = LatticeTin::kSouthEast;
constexpr std::array<Step, 8> kSteps = {{{1, 0, 0, -1, kSW | kSE, 0, 0, kNW | kNE},
                                         {1, 1, 0, -1, kNW, 0, -1, kSE},
                                         {0, 1, -1, -1, kNE | kSE, 0, -1, kNW | kSW},
                                         {-1, 1, -1, -1, kSW, -1, -1, kNE},
                                         {-1, 0, -1, 0, kNW | kNE, -1, -1, kSW | kSE},
                                         {-1, -1, -1, 0, kSE, -1, 0, kNW},
                                         {0, -1, 0, 0, kNW | kSW, -1, 0, kNE | kSE},
                                         {1, -1, 0, 0, kNE, 0, 0, kSW}}};

class LatticeReader {
 public:
  LatticeReader(const PointIndex& index, const Selection& selection, const Window& window, const Grid& grid,
                Progress& progress)
      : index_(index),
        selection_(selection),
        whole_(window),
        window_(window, grid, index.bounds()),
        progress_(progress) {
    lattice_.grid = grid;
  }

  std::optional<LatticeTin> run(std::uint64_t most_posts) {
    if (!find_lattice(most_posts)) return std::nullopt;
    lattice_.heights.assign(std::size_t{lattice_.columns} * lattice_.rows, LatticeTin::kNoPost);
    lattice_.halves.assign(lattice_.heights.size(), 0);
    mark_cells();
    if (!read_posts()) return std::nullopt;
    join_posts();
    if (!ends_at_outline() || !reaches_every_part()) return std::nullopt;
    cut();
    return std::move(lattice_);
  }

  /// Where it would be; no heights yet.
  bool find_lattice(std::uint64_t most_posts) {
    if (!find_leaves(0)) return false;
    std::vector<Leaf> fullest(std::min(kSamples, leaves_.size()));
    std::partial_sort_copy(leaves_.begin(), leaves_.end(), fullest.begin(), fullest.end(),
                           [](const Leaf& a, const Leaf& b) { return a.points > b.points; });
    std::int64_t spacing = 0;
    std::optional<GridPoint> first;
    for (const Leaf& leaf : fullest) {
      for (const GridPoint& p : index_.block(leaf)->points) {
        if (!window_.bounds().contains(p.x, p.y)) continue;
        if (!first) first = p;
        spacing = std::gcd(std::gcd(spacing, std::int64_t{p.x} - first->x), std::int64_t{p.y} - first->y);
      }
    }
    if (spacing == 0) return false;
    const GridPoint origin = *first;
    const auto margin = static_cast<double>(spacing);
    if (!find_leaves(margin)) return false;
    // Whole cells about what there is, and a bare one all around.
    const GridBox box = intersection(expanded(window_.bounds(), margin), index_.bounds());
    if (box.empty()) return false;
    const auto floor_of = [&](std::int64_t v) { return v - ((v % spacing) + spacing) % spacing; };
    const std::int64_t west = floor_of(std::int64_t{box.xmin} - origin.x) - spacing,
                       east = -floor_of(origin.x - std::int64_t{box.xmax}) + spacing,
                       south = floor_of(std::int64_t{box.ymin} - origin.y) - spacing,
                       north = -floor_of(origin.y - std::int64_t{box.ymax}) + spacing;
    const auto columns = static_cast<std::uint64_t>((east - west) / spacing + 1),
               rows = static_cast<std::uint64_t>((north - south) / spacing + 1);
    std::uint64_t points = 0;
    for (const Leaf& leaf : leaves_) points += leaf.points;
    if (columns * rows > std::min(most_posts, kEmptiest * points + 4 * (columns + rows))) return false;
    lattice_.spacing = static_cast<std::int32_t>(spacing);
    lattice_.west = static_cast<std::int32_t>(origin.x + west);
    lattice_.north = static_cast<std::int32_t>(origin.y + north);
    lattice_.columns = static_cast<std::uint32_t>(columns), lattice_.rows = static_cast<std::uint32_t>(rows);
    return true;
  }

 private:
  bool find_leaves(double margin) {
    leaves_.clear();
    selected_leaves(index_, selection_, expanded(window_.bounds(), margin), leaves_);
    return !leaves_.empty() && std::none_of(leaves_.begin(), leaves_.end(), [](const Leaf& l) { return l.theme != 0; });
  }

  GridBox box_of(std::uint32_t column, std::uint32_t row, std::uint32_t end_column, std::uint32_t end_row) const {
    return {lattice_.x(column), lattice_.y(end_row), lattice_.x(end_column), lattice_.y(row)};
  }

  /// Those that meet the window are known.
  void mark_cells() {
    const std::uint32_t columns = lattice_.columns - 1, rows = lattice_.rows - 1;
    parallel_for((rows + kBlock - 1) / kBlock, [&](std::size_t strip) {
      const auto first_row = static_cast<std::uint32_t>(strip) * kBlock;
      const std::uint32_t end_row = std::min(rows, first_row + kBlock);
      for (std::uint32_t first = 0; first < columns; first += kBlock) {
        const std::uint32_t end = std::min(columns, first + kBlock);
        const GridBox block = box_of(first, first_row, end, end_row);
        const bool all = whole_.is_all() || window_.holds(block);
        if (!all && !window_.meets(block)) continue;
        for (std::uint32_t row = first_row; row < end_row; ++row) {
          for (std::uint32_t column = first; column < end; ++column) {
            std::uint8_t& cell = lattice_.halves[lattice_.index(column, row)];
            if (all) {
              cell = kKnown;
            } else if (window_.meets(box_of(column, row, column + 1, row + 1))) {
              cell = kKnown | kCut;
            }
          }
        }
      }
    });
  }

  /// False where one among them lies off the lattice.
  bool read_posts() {
    std::erase_if(leaves_, [&](const Leaf& leaf) {
      return !whole_.is_all() && !window_.meets(expanded(leaf.cell.box(), lattice_.spacing));
    });
    const std::size_t tasks = (leaves_.size() + kLeavesATask - 1) / kLeavesATask;
    std::atomic<bool> odd = false;
    std::atomic<std::size_t> done = 0;
    parallel_for(tasks, [&](std::size_t task) {
      progress_.throw_if_cancelled();
      const std::size_t end = std::min(leaves_.size(), (task + 1) * kLeavesATask);
      for (std::size_t i = task * kLeavesATask; i < end && !odd; ++i)
        if (!place(*index_.block_once(leaves_[i]))) odd = true;
      progress_.report("reading", static_cast<double>(++done) / static_cast<double>(tasks));
    });
    for (const Leaf& leaf : leaves_) lattice_.statistics += {leaf.points, 1};
    return !odd;
  }

  bool place(const Block& block) {
    const auto spacing = static_cast<std::uint32_t>(lattice_.spacing);
    for (const GridPoint& p : block.points) {
      // What lies beyond the lattice comes out as far too much.
      const auto east = static_cast<std::uint32_t>(p.x - lattice_.west),
                 south = static_cast<std::uint32_t>(lattice_.north - p.y);
      const std::uint32_t column = east / spacing, row = south / spacing;
      if (column >= lattice_.columns || row >= lattice_.rows) continue;
      if (column * spacing != east || row * spacing != south) {
        if (near_known(column, row)) return false;
        continue;
      }
      lattice_.heights[lattice_.index(column, row)] = p.z;
    }
    return true;
  }

  /// Whether it may lie in the circle about a known cell.
  bool near_known(std::uint32_t column, std::uint32_t row) const {
    for (const int dx : {-1, 0, 1})
      for (const int dy : {-1, 0, 1})
        if (known_cell(column, row, dx, dy) != nullptr) return true;
    return false;
  }

  void join_posts() {
    parallel_for(lattice_.rows - 1, [&](std::size_t r) {
      const std::size_t first = lattice_.index(0, static_cast<std::uint32_t>(r));
      const auto there = [&](std::size_t post) { return lattice_.heights[post] != LatticeTin::kNoPost ? 1U : 0U; };
      for (std::size_t cell = first; cell < first + lattice_.columns - 1; ++cell) {
        if ((lattice_.halves[cell] & kKnown) == 0) continue;
        const std::size_t below = cell + lattice_.columns;
        lattice_.halves[cell] |=
            kHalvesOfPosts[there(cell) | there(cell + 1) << 1 | there(below) << 2 | there(below + 1) << 3];
      }
    });
  }

  /// An edge of a cell or a diagonal, by its first post and its direction.
  using Edge = std::pair<std::size_t, std::uint8_t>;

  const std::uint8_t* known_cell(std::uint32_t column, std::uint32_t row, int dx, int dy) const {
    const std::int64_t c = std::int64_t{column} + dx, r = std::int64_t{row} + dy;
    if (c < 0 || r < 0 || c >= lattice_.columns || r >= lattice_.rows) return nullptr;
    const std::uint8_t* const cell =
        &lattice_.halves[lattice_.index(static_cast<std::uint32_t>(c), static_cast<std::uint32_t>(r))];
    return (*cell & kKnown) != 0 ? cell : nullptr;
  }

  /// Of known halves, those with nothing beyond, which is known as well.
  std::vector<Edge> edges_without_twin() const {
    std::vector<std::vector<Edge>> of_rows(lattice_.rows - 1);
    parallel_for(of_rows.size(), [&](std::size_t r) {
      const auto row = static_cast<std::uint32_t>(r);
      for (std::uint32_t column = 0; column + 1 < lattice_.columns; ++column) {
        const std::uint8_t* const cell = &lattice_.halves[lattice_.index(column, row)];
        const auto full = [&](const std::uint8_t* c) { return (*c & kHalves) == LatticeTin::kFalling; };
        if ((*cell & kHalves) == 0 || (full(cell) && full(cell - 1) && full(cell + 1) &&
                                       full(cell - lattice_.columns) && full(cell + lattice_.columns)))
          continue;
        for (unsigned direction = 0; direction < kSteps.size(); ++direction) {
          const Step& step = kSteps[direction];
          if ((*cell & step.left_halves) == 0) continue;
          const std::uint32_t from_column = column - static_cast<std::uint32_t>(step.left_dx),
                              from_row = row - static_cast<std::uint32_t>(step.left_dy);
          const std::uint8_t* const beyond = known_cell(from_column, from_row, step.right_dx, step.right_dy);
          if (beyond != nullptr && (*beyond & step.right_halves) == 0)
            of_rows[r].emplace_back(lattice_.index(from_column, from_row), static_cast<std::uint8_t>(direction));
        }
      }
    });
    std::vector<Edge> edges;
    for (const std::vector<Edge>& row : of_rows) edges.insert(edges.end(), row.begin(), row.end());
    return edges;
  }

  /// Adds the outline's edges between known cells. False where it does not go along with the halves there are.
  bool add_edges_of(const Segment& s, std::vector<Edge>& edges) const {
    const std::int64_t spacing = lattice_.spacing, dx = std::int64_t{s.bx} - s.ax, dy = std::int64_t{s.by} - s.ay;
    const std::int64_t east = std::int64_t{s.ax} - lattice_.west, south = std::int64_t{lattice_.north} - s.ay;
    if (east % spacing != 0 || south % spacing != 0 || dx % spacing != 0 || dy % spacing != 0) return false;
    const std::int64_t length = std::max(std::abs(dx), std::abs(dy));
    if ((dx != 0 && std::abs(dx) != length) || (dy != 0 && std::abs(dy) != length)) return false;
    const auto sign = [](std::int64_t v) { return (v > 0) - (v < 0); };
    const auto direction =
        static_cast<std::uint8_t>(std::find_if(kSteps.begin(), kSteps.end(),
                                               [&](const Step& t) { return t.dx == sign(dx) && t.dy == sign(dy); }) -
                                  kSteps.begin());
    const Step& step = kSteps[direction];
    for (std::int64_t i = 0; i < length / spacing; ++i) {
      const std::int64_t c = east / spacing + i * step.dx, r = south / spacing - i * step.dy;
      if (c < 0 || r < 0 || c >= lattice_.columns || r >= lattice_.rows) continue;
      const auto column = static_cast<std::uint32_t>(c), row = static_cast<std::uint32_t>(r);
      const std::uint8_t* const left = known_cell(column, row, step.left_dx, step.left_dy);
      const std::uint8_t* const right = known_cell(column, row, step.right_dx, step.right_dy);
      if (left != nullptr && (*left & step.left_halves) == 0) return false;
      if (right != nullptr && (*right & step.right_halves) != 0) return false;
      if (left != nullptr && right != nullptr) edges.emplace_back(lattice_.index(column, row), direction);
    }
    return true;
  }

  bool ends_at_outline() const {
    std::vector<Segment> segments;
    index_.segments(expanded(window_.bounds(), lattice_.spacing), segments);
    std::vector<Edge> outline;
    for (const Segment& s : segments) {
      if (!selection_.selects(s)) continue;
      if (s.theme != kCoverage || !add_edges_of(s, outline)) return false;
    }
    std::sort(outline.begin(), outline.end());
    outline.erase(std::unique(outline.begin(), outline.end()), outline.end());
    std::vector<Edge> edges = edges_without_twin();
    std::sort(edges.begin(), edges.end());
    return edges == outline;
  }

  /// What is known of each part hangs together with halves that are there.
  bool reaches_every_part() const {
    if (whole_.parts().size() < 2)
      return std::any_of(lattice_.halves.begin(), lattice_.halves.end(),
                         [](std::uint8_t c) { return (c & kHalves) != 0; });
    return std::all_of(whole_.parts().begin(), whole_.parts().end(), [&](const Window::Polygon& polygon) {
      const GridWindow part(Window::polygons({polygon}), lattice_.grid, index_.bounds());
      const auto number = [&](std::int64_t units, std::uint32_t count) {
        return static_cast<std::uint32_t>(std::clamp<std::int64_t>(units / lattice_.spacing, 0, count - 1));
      };
      const GridBox box = part.bounds();
      const std::uint32_t first = number(std::int64_t{box.xmin} - lattice_.west, lattice_.columns),
                          last = number(std::int64_t{box.xmax} - lattice_.west, lattice_.columns),
                          bottom = number(std::int64_t{lattice_.north} - box.ymin, lattice_.rows);
      bool known = false;
      for (std::uint32_t row = number(std::int64_t{lattice_.north} - box.ymax, lattice_.rows); row <= bottom; ++row) {
        for (std::uint32_t column = first; column <= last; ++column) {
          if (!part.meets(box_of(column, row, column + 1, row + 1))) continue;
          known = true;
          if ((lattice_.halves[lattice_.index(column, row)] & kHalves) != 0) return true;
        }
      }
      return !known;
    });
  }

  /// Leaves out the halves that do not meet the window.
  void cut() {
    parallel_for(lattice_.rows, [&](std::size_t r) {
      const std::size_t first = lattice_.index(0, static_cast<std::uint32_t>(r));
      for (std::size_t cell = first; cell < first + lattice_.columns; ++cell) {
        std::uint8_t& halves = lattice_.halves[cell];
        const bool check = (halves & kCut) != 0;
        halves &= kHalves;
        if (!check) continue;
        std::uint8_t out = 0;
        lattice_.for_each_triangle(cell, [&](std::uint32_t t) {
          const auto [a, b, c] = lattice_.corners(t);
          if (!window_.meets(a, b, c)) out |= t % 2 == 0 ? LatticeTin::kFirst : LatticeTin::kSecond;
          return true;
        });
        halves &= static_cast<std::uint8_t>(~out);
      }
    });
  }

  const PointIndex& index_;
  const Selection& selection_;
  const Window& whole_;
  GridWindow window_;
  Progress& progress_;
  std::vector<Leaf> leaves_;
  LatticeTin lattice_;
};

}  // namespace

std::optional<LatticeTin> triangulate_lattice(const Store& store, const Window& window, const ThemeChoice& themes,
                                              std::uint64_t most_posts, Progress& progress) {
  const StoreMetadata& metadata = store.metadata();
  const Selection selection = selection_of(metadata, Detail::tolerance(0), themes);
  const StandingIndex index(store, selection);
  return LatticeReader(index, selection, window, metadata.grid, progress).run(most_posts);
}

bool looks_like_lattice(const Store& store, const Window& window, const ThemeChoice& themes, std::uint64_t most_posts) {
  const StoreMetadata& metadata = store.metadata();
  const Selection selection = selection_of(metadata, Detail::tolerance(0), themes);
  const StandingIndex index(store, selection);
  NoProgress progress;
  return LatticeReader(index, selection, window, metadata.grid, progress).find_lattice(most_posts);
}

}  // namespace itin
