#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <itin/bucket_lists.hpp>
#include <itin/lattice_reader.hpp>
#include <itin/parallel.hpp>
#include <itin/precondition.hpp>
#include <itin/sort_unique.hpp>

#include "lattice/lattice_cover.hpp"
#include "lattice/post_sheet.hpp"
#include "store/prevailing_lattice.hpp"
#include "triangulate/apex/selection.hpp"
#include "triangulate/raised_index.hpp"
#include "triangulate/region/grid_window.hpp"
#include "triangulate/region/window_leaves.hpp"

namespace itin {

namespace {

/// A lattice must have at least one of this many of its posts. Without heights, which take most of the memory, fewer
/// posts are enough.
constexpr std::uint64_t kEmptiest = 4, kEmptiestWithoutHeights = 64;
constexpr std::size_t kLeavesPerTask = 16;
/// The widest leaf, in posts, that bounds the height of a tile. Wider leaves have few posts, so these are read instead.
constexpr std::int64_t kWidestToBound = LatticeTin::kSide;

}  // namespace

class LatticeReader::Work {
 public:
  /// Refers to the store, which must outlive it.
  Work(const Store& store, const Window& window, const ThemeChoice& themes)
      : selection_(selection_of(store.metadata(), Detail::tolerance(0), themes)),
        index_(store, selection_),
        whole_(window),
        window_(whole_, store.metadata().grid, index_.bounds()),
        everything_(whole_.is_all() || window_.holds(index_.bounds())) {
    lattice_.grid = store.metadata().grid;
    for (const SourceInfo& source : store.metadata().sources)
      widest_spacing_ = std::max(widest_spacing_, std::ceil(source.spacing / lattice_.grid.resolution));
  }

  /// Lays the lattice out in its place, without ground. Returns false where there is none.
  bool find_lattice(Heights heights, std::uint64_t most_posts);
  bool open(Heights heights, std::uint64_t most_posts, Progress& progress);
  void read(std::span<const std::uint32_t> tiles, Progress& progress);

  LatticeTin lattice_;
  std::vector<std::int32_t> highest_;  ///< one for each tile, grid units; empty where all heights were read at once

 private:
  std::vector<Leaf> leaves_within(double margin) const { return leaves_about(index_, selection_, window_, margin); }
  bool read_posts(Heights heights, Progress& progress);
  bool place(const Leaf& leaf, Heights heights);
  bool place_unread(const Leaf& leaf);
  bool on_lattice(const Leaf& leaf) const;
  bool bounded() const;
  bool bounds_well(const Leaf& leaf) const {
    return std::int64_t{1} << leaf.cell.log2_side <= kWidestToBound * lattice_.spacing;
  }
  void rise(std::uint32_t tile, std::int32_t z) {
    const std::atomic_ref<std::int32_t> highest(highest_[tile]);
    for (std::int32_t now = highest; now < z && !highest.compare_exchange_weak(now, z);) continue;
  }
  template <class Visit>
  bool for_each_post(const Block& block, const Visit& visit);
  template <class Visit>
  void for_each_tile(const Leaf& leaf, const Visit& visit) const;
  void list_leaves_of_tiles();
  void read_leaves(std::span<const std::uint32_t> leaves, Progress& progress);
  std::optional<PostSheet> sheet_of(const Leaf& leaf) const;
  void set_heights(const PostSheet& sheet);
  void set_heights(std::uint32_t tile, const PostSheet& sheet);

  void begin_reading(std::uint32_t tile) {
    lattice_.make_heights(tile);
    being_read_[tile] = true;
  }
  /// Sets the height in the tiles that are being read.
  void set_height(const PointPlace& place, std::int32_t z) {
    lattice_.for_each_tile_of(place.column, place.row, [&](std::uint32_t tile, std::uint32_t post) {
      if (being_read_[tile]) (*lattice_.tiles[tile].heights)[post] = z;
    });
  }

  Selection selection_;
  RaisedIndex index_;
  Window whole_;
  GridWindow window_;
  bool everything_;
  double widest_spacing_ = 0;  ///< the greatest spacing of any source, grid units
  std::vector<Leaf> leaves_;
  std::optional<LatticeCover> cover_;  ///< present while the reader is being opened
  std::vector<bool> being_read_;       ///< one for each tile
  BucketLists leaves_of_tile_;
};

bool LatticeReader::Work::find_lattice(Heights heights, std::uint64_t most_posts) {
  std::vector<Leaf> leaves = leaves_within(widest_spacing_);
  const std::optional<PostLattice> posts = prevailing_lattice(index_, leaves, window_.bounds());
  if (!posts) return false;
  const auto margin = static_cast<double>(posts->side());
  if (margin > widest_spacing_) {
    leaves = leaves_within(margin);
  } else if (margin < widest_spacing_) {
    keep_leaves_about(window_, margin, leaves);
  }
  if (!std::all_of(leaves.begin(), leaves.end(), [](const Leaf& leaf) { return leaf.theme == 0; })) return false;
  const GridBox box = intersection(expanded(window_.bounds(), margin), index_.bounds());
  if (box.empty() || !lay(*posts, box, lattice_)) return false;
  std::uint64_t points = 0;
  for (const Leaf& leaf : leaves) points += leaf.points;
  cover_.emplace(lattice_, window_, everything_);
  const std::uint64_t emptiest = heights == Heights::kAll ? kEmptiest : kEmptiestWithoutHeights;
  if (cover_->most_posts() >
      std::min(most_posts, emptiest * points + 4 * (std::uint64_t{lattice_.columns} + lattice_.rows)))
    return false;
  leaves_ = std::move(leaves);
  return true;
}

bool LatticeReader::Work::open(Heights heights, std::uint64_t most_posts, Progress& progress) {
  if (!find_lattice(heights, most_posts)) return false;
  if (heights == Heights::kAll) {
    being_read_.assign(lattice_.tiles.size(), false);
    for (std::uint32_t t = 0; t < lattice_.tiles.size(); ++t)
      if (cover_->reaches(t)) begin_reading(t);
  } else {
    highest_.assign(lattice_.tiles.size(), std::numeric_limits<std::int32_t>::min());
  }
  if (!read_posts(heights, progress)) return false;
  cover_->join();
  if (!bounded()) return false;
  cover_->cut();
  cover_.reset();
  if (heights == Heights::kNone) list_leaves_of_tiles();
  return true;
}

/// Reads the posts. Returns false where one of them lies off the lattice.
bool LatticeReader::Work::read_posts(Heights heights, Progress& progress) {
  lattice_.lowest = std::numeric_limits<std::int32_t>::max(), lattice_.highest = -lattice_.lowest;
  for (const Leaf& leaf : leaves_) {
    lattice_.statistics += {leaf.points, 1};
    lattice_.lowest = std::min(lattice_.lowest, leaf.zmin), lattice_.highest = std::max(lattice_.highest, leaf.zmax);
  }
  std::atomic<bool> odd = false;
  std::atomic<std::size_t> done = 0;
  parallel_for((leaves_.size() + kLeavesPerTask - 1) / kLeavesPerTask, [&](std::size_t task) {
    progress.throw_if_cancelled();
    const std::size_t first = task * kLeavesPerTask, last = std::min(leaves_.size(), first + kLeavesPerTask);
    for (std::size_t i = first; i < last && !odd; ++i) {
      const bool unread = heights == Heights::kNone && bounds_well(leaves_[i]);
      if (!(unread ? place_unread(leaves_[i]) : place(leaves_[i], heights))) odd = true;
    }
    progress.report("reading", static_cast<double>(done += last - first) / static_cast<double>(leaves_.size()));
  });
  return !odd;
}

/// Returns the leaf's heights as a rectangle of posts; nothing where they are none, or lie off the lattice.
std::optional<PostSheet> LatticeReader::Work::sheet_of(const Leaf& leaf) const {
  std::optional<PostHeights> posts = index_.posts_once(leaf);
  return posts ? PostSheet::of(std::move(*posts), lattice_) : std::nullopt;
}

bool LatticeReader::Work::place(const Leaf& leaf, Heights heights) {
  if (heights == Heights::kAll) {
    if (const auto sheet = sheet_of(leaf)) {
      cover_->fill(sheet->places);
      set_heights(*sheet);
      return true;
    }
  }
  const auto block = heights == Heights::kNone ? index_.unordered_block(leaf) : index_.block_once(leaf);
  return for_each_post(*block, [&](const PointPlace& place, std::int32_t z) {
    if (heights == Heights::kAll) {
      set_height(place, z);
    } else {
      lattice_.for_each_tile_of(place.column, place.row, [&](std::uint32_t tile, std::uint32_t) { rise(tile, z); });
    }
  });
}

/// Places the posts of a leaf whose heights are not asked for. If all of them lie on the lattice, and are as many as
/// the places in the leaf's cell, they fill these places and need not be read.
bool LatticeReader::Work::place_unread(const Leaf& leaf) {
  for_each_tile(leaf, [&](std::uint32_t tile) { rise(tile, leaf.zmax); });
  const auto places = places_of(lattice_, leaf.cell.box());
  if (places && cover_->lacks(*places) == leaf.points && on_lattice(leaf)) {
    cover_->fill(*places);
    return true;
  }
  return for_each_post(*index_.plan_once(leaf), [](const PointPlace&, std::int32_t) {});
}

/// Tells whether all of a leaf's points are known to lie on the lattice.
bool LatticeReader::Work::on_lattice(const Leaf& leaf) const {
  if (index_.any_raised()) return false;
  const PostLattice posts = index_.lattice_of(leaf);
  const std::int64_t spacing = lattice_.spacing;
  return posts.side() % spacing == 0 && (posts.x - lattice_.west) % spacing == 0 &&
         (posts.y - lattice_.north) % spacing == 0;
}

/// Adds the block's posts to the cover and calls visit(place, height) for each. Returns false as soon as a point lies
/// off the lattice, near known cells.
template <class Visit>
bool LatticeReader::Work::for_each_post(const Block& block, const Visit& visit) {
  for (const GridPoint& p : block.points) {
    const auto place = place_of(lattice_, p);
    if (!place) continue;
    if (!place->post) {
      if (cover_->near_known(place->column, place->row)) return false;
      continue;
    }
    cover_->add(place->column, place->row);
    visit(*place, p.z);
  }
  return true;
}

bool LatticeReader::Work::bounded() const {
  std::vector<Segment> segments;
  index_.segments(expanded(window_.bounds(), lattice_.spacing), segments);
  std::erase_if(segments, [&](const Segment& s) { return !selection_.selects(s); });
  if (std::any_of(segments.begin(), segments.end(), [](const Segment& s) { return s.theme != kCoverage; }) ||
      !cover_->ends_at(segments))
    return false;
  // For the proof, the known ground of each part must be connected with existing halves.
  if (whole_.parts().size() < 2) return cover_->any();
  return std::all_of(whole_.parts().begin(), whole_.parts().end(), [&](const Window::Polygon& polygon) {
    return cover_->reaches(GridWindow(Window::polygons({polygon}), lattice_.grid, index_.bounds()));
  });
}

/// Calls visit(tile) for every tile that may have posts of the leaf.
template <class Visit>
void LatticeReader::Work::for_each_tile(const Leaf& leaf, const Visit& visit) const {
  const GridBox box = leaf.cell.box();
  // The tile of a post reaches up to the post itself, from the west and the north.
  const auto first = [&](std::int64_t units) {
    return std::max<std::int64_t>(0, (units - 1) / lattice_.spacing) / LatticeTin::kSide;
  };
  const auto last = [&](std::int64_t units, std::uint32_t count) {
    return std::min<std::int64_t>(units / lattice_.spacing / LatticeTin::kSide, std::int64_t{count} - 1);
  };
  if (std::int64_t{box.xmax} < lattice_.west || std::int64_t{box.ymin} > lattice_.north) return;
  const std::int64_t first_column = first(std::int64_t{box.xmin} - lattice_.west),
                     last_column = last(std::int64_t{box.xmax} - lattice_.west, lattice_.tile_columns()),
                     last_row = last(std::int64_t{lattice_.north} - box.ymin, lattice_.tile_rows());
  for (std::int64_t row = first(std::int64_t{lattice_.north} - box.ymax); row <= last_row; ++row)
    for (std::int64_t column = first_column; column <= last_column; ++column)
      visit(static_cast<std::uint32_t>(row * lattice_.tile_columns() + column));
}

void LatticeReader::Work::list_leaves_of_tiles() {
  leaves_of_tile_ = {lattice_.tiles.size(), leaves_.size(),
                     [this](std::uint32_t i, const auto& add) { for_each_tile(leaves_[i], add); }};
}

void LatticeReader::Work::read(std::span<const std::uint32_t> tiles, Progress& progress) {
  being_read_.assign(lattice_.tiles.size(), false);
  std::vector<std::uint32_t> leaves;
  for (const std::uint32_t t : tiles) {
    if (lattice_.tiles[t].ground == LatticeTin::Ground::kNone || lattice_.tiles[t].heights) continue;
    begin_reading(t);
    const auto of_tile = leaves_of_tile_.in(t);
    leaves.insert(leaves.end(), of_tile.begin(), of_tile.end());
  }
  sort_unique(leaves);
  try {
    read_leaves(leaves, progress);
  } catch (...) {
    for (std::size_t t = 0; t < being_read_.size(); ++t)
      if (being_read_[t]) lattice_.tiles[t].heights.reset();
    throw;
  }
}

/// Sets the heights of a rectangle of posts in the tiles that are being read.
void LatticeReader::Work::set_heights(const PostSheet& sheet) {
  const auto [west, north, east, south] = sheet.places;
  const auto before = [](std::uint32_t place) { return place > 0 ? (place - 1) / LatticeTin::kSide : 0; };
  for (std::uint32_t row = before(north); row <= std::min(south / LatticeTin::kSide, lattice_.tile_rows() - 1); ++row)
    for (std::uint32_t column = before(west); column <= std::min(east / LatticeTin::kSide, lattice_.tile_columns() - 1);
         ++column) {
      const std::uint32_t tile = row * lattice_.tile_columns() + column;
      if (being_read_[tile]) set_heights(tile, sheet);
    }
}

void LatticeReader::Work::set_heights(std::uint32_t tile, const PostSheet& sheet) {
  const std::uint32_t first_column = tile % lattice_.tile_columns() * LatticeTin::kSide,
                      first_row = tile / lattice_.tile_columns() * LatticeTin::kSide;
  const PlaceBox& places = sheet.places;
  const std::uint32_t west = std::max(places.west, first_column),
                      east = std::min(places.east, first_column + LatticeTin::kSide),
                      north = std::max(places.north, first_row),
                      south = std::min(places.south, first_row + LatticeTin::kSide);
  for (std::uint32_t row = north; row <= south; ++row)
    std::copy_n(sheet.row(row) + (west - places.west), east - west + 1,
                lattice_.tiles[tile].heights->data() + (row - first_row) * LatticeTin::kPosts + (west - first_column));
}

/// Reads leaves into the tiles that are being read.
void LatticeReader::Work::read_leaves(std::span<const std::uint32_t> leaves, Progress& progress) {
  parallel_for((leaves.size() + kLeavesPerTask - 1) / kLeavesPerTask, [&](std::size_t task) {
    progress.throw_if_cancelled();
    for (std::size_t i = task * kLeavesPerTask; i < std::min(leaves.size(), (task + 1) * kLeavesPerTask); ++i) {
      const Leaf& leaf = leaves_[leaves[i]];
      if (const auto sheet = sheet_of(leaf)) {
        set_heights(*sheet);
        continue;
      }
      // Wide leaves are read again and again, so they are cached.
      const auto block = bounds_well(leaf) ? index_.block_once(leaf) : index_.unordered_block(leaf);
      for (const GridPoint& p : block->points) {
        const auto place = place_of(lattice_, p);
        if (place && place->post) set_height(*place, p.z);
      }
    }
  });
}

std::unique_ptr<LatticeReader> LatticeReader::open(const Store& store, const Window& window, const ThemeChoice& themes,
                                                   Heights heights, std::uint64_t most_posts, Progress& progress) {
  auto work = std::make_unique<Work>(store, window, themes);
  if (!work->open(heights, most_posts, progress)) return nullptr;
  return std::unique_ptr<LatticeReader>(new LatticeReader(std::move(work)));
}

bool LatticeReader::may_open(const Store& store, const Window& window, const ThemeChoice& themes,
                             std::uint64_t most_posts) {
  return Work(store, window, themes).find_lattice(Heights::kAll, most_posts);
}

LatticeReader::LatticeReader(std::unique_ptr<Work> work) : work_(std::move(work)) {}
LatticeReader::~LatticeReader() = default;

const LatticeTin& LatticeReader::lattice() const {
  return work_->lattice_;
}
LatticeTin LatticeReader::take() {
  return std::move(work_->lattice_);
}
std::int32_t LatticeReader::highest(std::uint32_t tile) const {
  ITIN_PRECONDITION(tile < work_->highest_.size());
  return work_->highest_[tile];
}
void LatticeReader::read(std::span<const std::uint32_t> tiles, Progress& progress) {
  work_->read(tiles, progress);
}
void LatticeReader::read_all(Progress& progress) {
  std::vector<std::uint32_t> all(work_->lattice_.tiles.size());
  std::iota(all.begin(), all.end(), 0U);
  work_->read(all, progress);
}

std::optional<LatticeTin> triangulate_lattice(const Store& store, const Window& window, const ThemeChoice& themes,
                                              std::uint64_t most_posts, Progress& progress) {
  const auto reader = LatticeReader::open(store, window, themes, LatticeReader::Heights::kAll, most_posts, progress);
  return reader ? std::optional(reader->take()) : std::nullopt;
}

}  // namespace itin
