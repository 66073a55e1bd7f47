#include <array>
#include <cmath>
#include <memory>
#include <mutex>

#include <itin/cross_section.hpp>
#include <itin/error.hpp>
#include <itin/store.hpp>

#include "cross_section/nearby_apex.hpp"
#include "cross_section/retrieval.hpp"
#include "cross_section/section_tile.hpp"
#include "cross_section/section_walk.hpp"
#include "store/block_cache.hpp"
#include "triangulate/region.hpp"

namespace itin {

namespace {

/// A tile's side in sides of the smallest leaf there is at a place: some thousand points.
constexpr int kTileLog2Leaves = 2;

/// Tiles by the cell they cover, made when first asked for.
class TileCache {
 public:
  TileCache(const PointIndex& index, const Selection& selection, std::uint64_t bytes)
      : index_(index), selection_(selection), cache_(bytes) {}

  const PointIndex& index() const { return index_; }
  const Selection& selection() const { return selection_; }

  /// A tile whose square contains the place; null where the place is far from all vertices.
  std::shared_ptr<const SectionTile> tile_at(Position place, RetrievalStatistics& statistics) {
    const std::optional<Cell> cell = cell_at(place);
    if (!cell) return nullptr;
    const std::uint64_t key = cell->code << 4 | static_cast<std::uint64_t>(cell->log2_side / 2);
    if (auto tile = find(key, *cell)) return tile;
    // Of several threads that want one tile the first makes it.
    const std::lock_guard lock(makers_[(key * 0x9e3779b97f4a7c15u) >> 58]);
    if (auto tile = find(key, *cell)) return tile;
    RegionMesh region = triangulate_region(index_, selection_, square_of(*cell));
    statistics += region.statistics;
    const auto tile = std::make_shared<const SectionTile>(square_of(*cell), std::move(region));
    cache_.insert(key, tile, tile->bytes());
    return tile;
  }

 private:
  std::shared_ptr<const SectionTile> find(std::uint64_t key, const Cell& cell) {
    auto tile = std::static_pointer_cast<const SectionTile>(cache_.find(key));
    return tile && tile->square() == square_of(cell) ? tile : nullptr;
  }

  /// Tiles of neighbouring places may overlap, which costs memory and nothing else.
  std::optional<Cell> cell_at(Position place) const {
    const GridBox box{place.x, place.y, place.x, place.y};
    std::vector<Leaf> leaves;
    index_.leaves(selection_.finest_in(box), box, leaves);
    if (leaves.empty()) return std::nullopt;
    Cell cell = leaves.front().cell;
    for (const Leaf& leaf : leaves) {
      if (leaf.cell.log2_side < cell.log2_side) cell = leaf.cell;
    }
    for (int i = 0; i < kTileLog2Leaves && cell.log2_side < kRootLog2Side; ++i) cell = cell.parent();
    return cell;
  }

  const PointIndex& index_;
  const Selection& selection_;
  BlockCache cache_;
  std::array<std::mutex, 64> makers_;
};

/// Walks one line through the tiles.
class TiledTriangles final : public TriangleFinder {
 public:
  TiledTriangles(TileCache& tiles, const SectionLine& line) : tiles_(tiles), line_(line) {}

  GridPoint beyond(const CrossedEdge& edge) override {
    std::uint32_t next = triangle_ == kNoTriangle ? kNoTriangle : tile_->neighbour(triangle_, edge);
    if (next == kNoTriangle) next = enter_tile(edge);
    triangle_ = next;
    return next == kNoTriangle ? beyond_by_retrieval(edge) : tile_->apex(next, edge);
  }

  std::vector<std::array<GridPoint, 3>> around(const GridBox& box) override {
    triangle_ = kNoTriangle;
    // A box that reaches over a tile's border touches it, and so do the triangles that meet it.
    if (!go_to({box.xmin, box.ymin})) return {};
    if (tile_->square().contains(box)) return tile_->around(box);
    const RegionMesh region = triangulate_region(tiles_.index(), tiles_.selection(), box);
    statistics_ += region.statistics;
    return SectionTile(box, region).around(box);
  }

  CrossedEdge edge_on(const OutlineCrossing& segment, const SectionLine& line, OnLine on_line) override {
    triangle_ = kNoTriangle;
    return find_edge_on(tiles_.index(), tiles_.selection(), segment, line, on_line, statistics_);
  }

  const RetrievalStatistics& statistics() const { return statistics_; }

 private:
  bool go_to(Position place) {
    if (!tile_ || !tile_->square().contains(place.x, place.y)) tile_ = tiles_.tile_at(place, statistics_);
    return tile_ != nullptr;
  }

  /// The triangle ahead of an edge in the tile where the line crosses it; kNoTriangle in the rare case that the
  /// crossing, rounded, is in a tile that the triangle does not meet.
  std::uint32_t enter_tile(const CrossedEdge& edge) {
    const Grid& grid = line_.grid();
    const GridPoint place = grid.quantise(line_.crossing(edge.left, edge.right).position);
    if (!go_to({place.x, place.y})) return kNoTriangle;
    return tile_->triangle_ahead(edge, {place.x, place.y});
  }

  GridPoint beyond_by_retrieval(const CrossedEdge& edge) {
    ApexSearch search(tiles_.index(), tiles_.selection());
    const auto found = search.apex({edge.left.x, edge.left.y}, {edge.right.x, edge.right.y});
    statistics_ += search.statistics();
    if (!found) throw Error("the ground ends without an outline; run itin check on the store");
    return found->point;
  }

  TileCache& tiles_;
  const SectionLine& line_;
  std::shared_ptr<const SectionTile> tile_;
  std::uint32_t triangle_ = kNoTriangle;
  RetrievalStatistics statistics_;
};

}  // namespace

class SectionSurface::Impl {
 public:
  Impl(const Store& store, const Detail& detail, const Options& options)
      : grid_(store.metadata().grid),
        selection_(selection_of(store, detail)),
        tiles_(store.points(), selection_, options.cache_bytes) {}

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
  TileCache tiles_;
};

SectionSurface::SectionSurface(const Store& store, const Detail& detail) : SectionSurface(store, detail, Options()) {}
SectionSurface::SectionSurface(const Store& store, const Detail& detail, const Options& options)
    : impl_(std::make_unique<Impl>(store, detail, options)) {}
SectionSurface::SectionSurface(SectionSurface&&) noexcept = default;
SectionSurface& SectionSurface::operator=(SectionSurface&&) noexcept = default;
SectionSurface::~SectionSurface() = default;

CrossSection SectionSurface::between(Point2 from, Point2 to) const {
  return impl_->between(from, to);
}

}  // namespace itin
