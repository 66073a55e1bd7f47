#include "cross_section/section_tiles.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/whole_division.hpp"
#include "triangulate/apex/read_once.hpp"
#include "triangulate/region/region.hpp"

namespace itin {

namespace {

/// The most points in a tile, about: a tile is the largest cell with no more.
constexpr double kPointsPerSectionTile = 8192;
/// The side where the search for a tile's size begins.
constexpr int kUsualLog2Side = 18;
/// The most cells per post: where posts are rarer, few cells have all four.
constexpr std::size_t kMostCellsPerPost = 4;
constexpr auto kMostCells = static_cast<std::int64_t>(kMostCellsPerPost * kPointsPerSectionTile);

/// Returns the key of a cell's tile. Its lowest set bit tells the size, as a code has 2 log2_side zeros at its end.
std::uint64_t tile_key(const Cell& cell) {
  return cell.code | std::uint64_t{1} << (2 * cell.log2_side - 1);
}
/// Returns the key of a cell's sheet; its highest bit is free, as codes have 60 bits.
std::uint64_t sheet_key(const Cell& cell) {
  return tile_key(cell) | std::uint64_t{1} << 63;
}

/// Returns the sheet of cells whose lower left posts are in a box; a sheet without cells where its points are no
/// lattice, or few of its places have posts.
LatticeSheet sheet_over(const GridBox& box, const ReadOnce& index, const Selection& selection) {
  if (box.empty()) return {};
  const std::optional<LatticeCell> any = cell_about(box, index, selection);
  if (!any) return {};
  const auto from = [&](std::int64_t low, std::int64_t post) {
    return post - floor_divide(post - low, any->side) * any->side;
  };
  const LatticeCell first{from(box.xmin, any->x), from(box.ymin, any->y), any->side};
  if (first.x > box.xmax || first.y > box.ymax) return {};
  const std::int64_t columns = (box.xmax - first.x) / any->side + 1, rows = (box.ymax - first.y) / any->side + 1;
  if (columns * rows > kMostCells) return {};
  LatticeSheet sheet(first, columns, rows);
  std::vector<Leaf> leaves;
  selected_leaves(index, selection, sheet.box(), leaves);
  for (const Leaf& leaf : leaves) sheet.add(leaf, *index.unordered_block(leaf), selection);
  if (kMostCellsPerPost * sheet.posts() < static_cast<std::size_t>(columns * rows)) return {};
  add_segments(sheet, index, selection);
  return sheet;
}

}  // namespace

SectionTiles::SectionTiles(const PointIndex& index, const Selection& selection, std::uint64_t cache_bytes)
    : index_(index), selection_(selection), cache_(cache_bytes) {}

std::shared_ptr<const SectionTile> SectionTiles::tile_at(Position place, RetrievalStatistics& statistics) {
  const Cell cell = cell_at(place);
  return found_or_made<SectionTile>(tile_key(cell), [&] {
    const RegionMesh region = triangulate_region(index_, selection_, square_of(cell));
    statistics += region.statistics;
    return std::make_shared<const SectionTile>(square_of(cell), region);
  });
}

std::shared_ptr<const SharedSheet> SectionTiles::sheet_at(Position place, RetrievalStatistics& statistics) {
  const Cell cell = cell_at(place);
  return found_or_made<SharedSheet>(sheet_key(cell), [&] {
    const ReadOnce blocks(index_);
    auto sheet =
        std::make_shared<const SharedSheet>(sheet_over(intersection(cell.box(), index_.bounds()), blocks, selection_));
    statistics += blocks.statistics();
    return sheet;
  });
}

template <class Made, class Make>
std::shared_ptr<const Made> SectionTiles::found_or_made(std::uint64_t key, const Make& make) {
  const auto find = [&] { return std::static_pointer_cast<const Made>(cache_.find(key)); };
  if (auto found = find()) return found;
  // When several threads want the same one, the first makes it.
  const std::lock_guard lock(makers_[(key * 0x9e3779b97f4a7c15u) >> 58]);
  if (auto found = find()) return found;
  const std::shared_ptr<const Made> made = make();
  cache_.insert(key, made, made->bytes());
  return made;
}

Cell SectionTiles::cell_at(Position place) {
  const std::uint64_t code = code_of(place);
  const auto with_side = [code](int log2_side) { return Cell{code >> (2 * log2_side) << (2 * log2_side), log2_side}; };
  Cell cell = with_side(kUsualLog2Side);
  while (cell.log2_side > 1 && !is_small(cell)) cell = with_side(cell.log2_side - 1);
  while (cell.log2_side < kRootLog2Side && is_small(cell.parent())) cell = cell.parent();
  return cell;
}

bool SectionTiles::is_small(const Cell& cell) {
  {
    const std::shared_lock lock(sizes_);
    if (const auto known = small_.find(tile_key(cell)); known != small_.end()) return known->second;
  }
  const GridBox box = cell.box();
  std::vector<Leaf> leaves;
  selected_leaves(index_, selection_, box, leaves);
  double points = 0;
  for (const Leaf& leaf : leaves) {
    points += leaf.asked * std::min(1.0, std::ldexp(1.0, 2 * (cell.log2_side - leaf.cell.log2_side)));
  }
  const std::lock_guard lock(sizes_);
  return small_[tile_key(cell)] = points <= kPointsPerSectionTile;
}

}  // namespace itin
