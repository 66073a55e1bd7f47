#include "cross_section/tiled_section.hpp"

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include <itin/error.hpp>

#include "cross_section/nearby_apex.hpp"
#include "cross_section/section_walk.hpp"
#include "cross_section/shared_cells.hpp"
#include "triangulate/apex/read_once.hpp"
#include "triangulate/region/region.hpp"

namespace itin {

namespace {

/// Walks one line through sheets of posts and, where these do not have the triangle, through tiles.
class TiledTriangles final : public TriangleFinder {
 public:
  TiledTriangles(SectionTiles& tiles, const SectionLine& line)
      : tiles_(tiles), line_(line), cells_(tiles, statistics_) {}

  SectionVertex beyond(const CrossedEdge& edge) override {
    if (at_.triangle != kNoTriangle) {
      const SectionVertex& apex = tile_->apex(at_);
      const bool keeps_left = edge.right.x == apex.x && edge.right.y == apex.y;
      at_ = tile_->onwards(at_, keeps_left);
    }
    if (at_.triangle != kNoTriangle) return tile_->apex(at_);
    if (const auto post = cells_.beyond({edge.left.x, edge.left.y}, {edge.right.x, edge.right.y})) return *post;
    const GridPoint place = line_.grid().quantise(line_.crossing(edge.left, edge.right).position);
    if (cells_.is_worth_a_tile({place.x, place.y})) enter_tile(edge, {place.x, place.y});
    return at_.triangle == kNoTriangle ? searched(edge) : tile_->apex(at_);
  }

  std::vector<std::array<SectionVertex, 3>> around(const GridBox& box) override {
    at_ = {};
    if (auto cells = cells_.around(box); !cells.empty()) return cells;
    if (cells_.is_worth_a_tile({box.xmin, box.ymin})) {
      go_to({box.xmin, box.ymin});
      if (tile_->square().contains(box)) return tile_->around(box);
    }
    const RegionMesh region = triangulate_region(tiles_.index(), tiles_.selection(), box);
    statistics_ += region.statistics;
    return SectionTile(box, region).around(box);
  }

  CrossedEdge edge_on(const OutlineCrossing& segment, const SectionLine& line, OnLine on_line) override {
    at_ = {};
    return find_edge_on(tiles_.index(), tiles_.selection(), segment, line, on_line, statistics_);
  }

  RetrievalStatistics statistics() const {
    RetrievalStatistics all = statistics_;
    if (search_) all += search_->blocks.statistics();
    return all;
  }

 private:
  /// Searches for single triangles.
  struct Search {
    Search(const PointIndex& index, const Selection& selection, Point2 heading)
        : blocks(index), apex(blocks, selection, heading) {}
    ReadOnce blocks;
    NearbyApex apex;
  };

  void go_to(Position place) {
    if (!tile_ || !tile_->square().contains(place.x, place.y)) tile_ = tiles_.tile_at(place, statistics_);
  }

  /// Goes to the triangle ahead of an edge, in the tile where the line crosses the edge. Finds none in the rare case
  /// that the rounded crossing is in a tile that the triangle does not meet.
  void enter_tile(const CrossedEdge& edge, Position place) {
    go_to(place);
    at_ = tile_->ahead(edge, place);
  }

  SectionVertex searched(const CrossedEdge& edge) {
    if (!search_) search_.emplace(tiles_.index(), tiles_.selection(), heading_of(line_));
    const auto found = search_->apex.apex({edge.left.x, edge.left.y}, {edge.right.x, edge.right.y});
    if (!found) throw Error("the ground ends without an outline; run itin check on the store");
    return *found;
  }

  SectionTiles& tiles_;
  const SectionLine& line_;
  RetrievalStatistics statistics_;
  SharedCells cells_;
  std::optional<Search> search_;
  std::shared_ptr<const SectionTile> tile_;
  SectionTile::Stop at_;  ///< in tile_
};

}  // namespace

CrossSection tiled_section(SectionTiles& tiles, const SectionLine& line) {
  TiledTriangles triangles(tiles, line);
  CrossSection section = walk_section(tiles.index(), line, triangles);
  section.statistics = triangles.statistics();
  return section;
}

}  // namespace itin
