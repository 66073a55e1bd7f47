#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <unordered_map>

#include <itin/cross_section.hpp>
#include <itin/error.hpp>
#include <itin/store.hpp>

#include "cross_section/nearby_apex.hpp"
#include "cross_section/retrieval.hpp"
#include "cross_section/section_tile.hpp"
#include "cross_section/section_walk.hpp"
#include "store/block_cache.hpp"
#include "triangulate/raised_index.hpp"
#include "triangulate/region.hpp"

namespace itin {

namespace {

/// A tile is the largest cell with at most about so many points: few enough to be made soon, enough to make its border
/// cheap.
constexpr double kPointsPerSectionTile = 8192;
/// The side where the search for a tile's size begins.
constexpr int kUsualLog2Side = 18;

/// Tiles by the cell they cover, made when first asked for.
class TileCache {
 public:
  TileCache(const PointIndex& index, const Selection& selection, std::uint64_t bytes)
      : index_(index), selection_(selection), cache_(bytes) {}

  const PointIndex& index() const { return index_; }
  const Selection& selection() const { return selection_; }

  /// The tile whose square contains the place.
  std::shared_ptr<const SectionTile> tile_at(Position place, RetrievalStatistics& statistics) {
    const Cell cell = cell_at(place);
    const std::uint64_t key = key_of(cell);
    if (auto tile = find(key)) return tile;
    // When several threads want one tile, the first makes it.
    const std::lock_guard lock(makers_[(key * 0x9e3779b97f4a7c15u) >> 58]);
    if (auto tile = find(key)) return tile;
    const RegionMesh region = triangulate_region(index_, selection_, square_of(cell));
    statistics += region.statistics;
    const auto tile = std::make_shared<const SectionTile>(square_of(cell), region);
    cache_.insert(key, tile, tile->bytes());
    return tile;
  }

 private:
  std::shared_ptr<const SectionTile> find(std::uint64_t key) {
    return std::static_pointer_cast<const SectionTile>(cache_.find(key));
  }

  /// The lowest bit set tells the size: a code has 2 log2_side zeros at its end.
  static std::uint64_t key_of(const Cell& cell) { return cell.code | std::uint64_t{1} << (2 * cell.log2_side - 1); }

  Cell cell_at(Position place) {
    const std::uint64_t code = code_of(place);
    const auto of_side = [code](int log2_side) { return Cell{code >> (2 * log2_side) << (2 * log2_side), log2_side}; };
    Cell cell = of_side(kUsualLog2Side);
    while (cell.log2_side > 1 && !is_small(cell)) cell = of_side(cell.log2_side - 1);
    while (cell.log2_side < kRootLog2Side && is_small(cell.parent())) cell = cell.parent();
    return cell;
  }

  bool is_small(const Cell& cell) {
    {
      const std::shared_lock lock(sizes_);
      if (const auto known = small_.find(key_of(cell)); known != small_.end()) return known->second;
    }
    const GridBox box = cell.box();
    std::vector<Leaf> leaves;
    selected_leaves(index_, selection_, box, leaves);
    double points = 0;
    for (const Leaf& leaf : leaves) {
      points += leaf.points * std::min(1.0, std::ldexp(1.0, 2 * (cell.log2_side - leaf.cell.log2_side)));
    }
    const std::lock_guard lock(sizes_);
    return small_[key_of(cell)] = points <= kPointsPerSectionTile;
  }

  const PointIndex& index_;
  const Selection& selection_;
  BlockCache cache_;
  std::shared_mutex sizes_;
  std::unordered_map<std::uint64_t, bool> small_;  ///< whether a cell has few enough points
  std::array<std::mutex, 64> makers_;
};

/// Walks one line through the tiles.
class TiledTriangles final : public TriangleFinder {
 public:
  TiledTriangles(TileCache& tiles, const SectionLine& line) : tiles_(tiles), line_(line) {}

  SectionVertex beyond(const CrossedEdge& edge) override {
    if (at_.triangle != kNoTriangle) {
      const SectionVertex& apex = tile_->apex(at_);
      const bool keeps_left = edge.right.x == apex.x && edge.right.y == apex.y;
      at_ = tile_->onwards(at_, keeps_left);
    }
    if (at_.triangle == kNoTriangle) enter_tile(edge);
    return at_.triangle == kNoTriangle ? beyond_by_retrieval(edge) : tile_->apex(at_);
  }

  std::vector<std::array<SectionVertex, 3>> around(const GridBox& box) override {
    at_ = {};
    go_to({box.xmin, box.ymin});
    if (tile_->square().contains(box)) return tile_->around(box);
    const RegionMesh region = triangulate_region(tiles_.index(), tiles_.selection(), box);
    statistics_ += region.statistics;
    return SectionTile(box, region).around(box);
  }

  CrossedEdge edge_on(const OutlineCrossing& segment, const SectionLine& line, OnLine on_line) override {
    at_ = {};
    return find_edge_on(tiles_.index(), tiles_.selection(), segment, line, on_line, statistics_);
  }

  const RetrievalStatistics& statistics() const { return statistics_; }

 private:
  void go_to(Position place) {
    if (!tile_ || !tile_->square().contains(place.x, place.y)) tile_ = tiles_.tile_at(place, statistics_);
  }

  /// Visits the triangle ahead of an edge in the tile where the line crosses it; none in the rare case that the
  /// crossing, rounded, is in a tile that the triangle does not meet.
  void enter_tile(const CrossedEdge& edge) {
    const Grid& grid = line_.grid();
    const GridPoint place = grid.quantise(line_.crossing(edge.left, edge.right).position);
    go_to({place.x, place.y});
    at_ = tile_->ahead(edge, {place.x, place.y});
  }

  SectionVertex beyond_by_retrieval(const CrossedEdge& edge) {
    ApexSearch search(tiles_.index(), tiles_.selection());
    const auto found = search.apex({edge.left.x, edge.left.y}, {edge.right.x, edge.right.y});
    statistics_ += search.statistics();
    if (!found) throw Error("the ground ends without an outline; run itin check on the store");
    return {found->point, found->theme};
  }

  TileCache& tiles_;
  const SectionLine& line_;
  std::shared_ptr<const SectionTile> tile_;
  SectionTile::Stop at_;  ///< where the walk stands in tile_
  RetrievalStatistics statistics_;
};

}  // namespace

class SectionSurface::Impl {
 public:
  Impl(const Store& store, const Detail& detail, const ThemeChoice& themes, const Options& options)
      : grid_(store.metadata().grid),
        selection_(selection_of(store.metadata(), detail, themes)),
        index_(store, selection_),
        tiles_(index_, selection_, options.cache_bytes) {}

  CrossSection between(Point2 from, Point2 to) {
    const SectionLine line(grid_, from, to);
    TiledTriangles triangles(tiles_, line);
    CrossSection section = walk_section(tiles_.index(), line, triangles);
    section.statistics = triangles.statistics();
    return section;
  }

 private:
  Grid grid_;
  Selection selection_;
  RaisedIndex index_;
  TileCache tiles_;
};

SectionSurface::SectionSurface(const Store& store, const Detail& detail, const ThemeChoice& themes)
    : SectionSurface(store, detail, themes, Options()) {}
SectionSurface::SectionSurface(const Store& store, const Detail& detail, const ThemeChoice& themes,
                               const Options& options)
    : impl_(std::make_unique<Impl>(store, detail, themes, options)) {}
SectionSurface::SectionSurface(SectionSurface&&) noexcept = default;
SectionSurface& SectionSurface::operator=(SectionSurface&&) noexcept = default;
SectionSurface::~SectionSurface() = default;

CrossSection SectionSurface::between(Point2 from, Point2 to) const {
  return impl_->between(from, to);
}

}  // namespace itin
