#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <itin/cross_section.hpp>
#include <itin/error.hpp>
#include <itin/store.hpp>

#include "cross_section/lattice_cells.hpp"
#include "cross_section/nearby_apex.hpp"
#include "cross_section/retrieval.hpp"
#include "cross_section/section_walk.hpp"
#include "triangulate/apex/read_once.hpp"
#include "triangulate/raised_index.hpp"
#include "triangulate/region/region.hpp"

namespace itin {

namespace {

/// Finds triangles by Smith's retrieval: one after another.
class RetrievedTriangles final : public TriangleFinder {
 public:
  RetrievedTriangles(const ReadOnce& index, const Selection& selection, Point2 heading, const Progress& progress)
      : index_(index),
        selection_(selection),
        progress_(progress),
        cells_(index, selection, heading),
        apex_(index, selection, heading) {}

  SectionVertex beyond(const CrossedEdge& edge) override {
    progress_.throw_if_cancelled();
    const Position left{edge.left.x, edge.left.y}, right{edge.right.x, edge.right.y};
    if (const auto post = cells_.beyond(left, right)) return *post;
    const auto found = apex_.apex(left, right);
    if (!found) throw Error("the ground ends without an outline; run itin check on the store");
    return *found;
  }

  std::vector<std::array<SectionVertex, 3>> around(const GridBox& box) override {
    if (box == box_) return around_;
    box_ = box;
    around_ = cells_.around(box);
    if (!around_.empty()) return around_;
    const RegionMesh region = triangulate_region(index_, selection_, box);
    const auto vertex = [&](std::uint32_t v) {
      return SectionVertex{region.vertices[v].point, region.vertices[v].theme};
    };
    for (const auto& [a, b, c] : region.mesh.triangles) around_.push_back({vertex(a), vertex(b), vertex(c)});
    return around_;
  }

  CrossedEdge edge_on(const OutlineCrossing& segment, const SectionLine& line, OnLine on_line) override {
    RetrievalStatistics counted_by_index;
    return find_edge_on(index_, selection_, segment, line, on_line, counted_by_index);
  }

 private:
  const ReadOnce& index_;
  const Selection& selection_;
  const Progress& progress_;
  LatticeCells cells_;
  NearbyApex apex_;
  GridBox box_;
  std::vector<std::array<SectionVertex, 3>> around_;
};

}  // namespace

CrossSection retrieve_section(const PointIndex& index, const Selection& selection, const SectionLine& line,
                              const Progress& progress) {
  const ReadOnce blocks(index);
  RetrievedTriangles triangles(blocks, selection, heading_of(line), progress);
  CrossSection section = walk_section(blocks, line, triangles);
  section.statistics = blocks.statistics();
  return section;
}

CrossSection cross_section(const Store& store, Point2 from, Point2 to, const Detail& detail, const ThemeChoice& themes,
                           const Progress& progress) {
  const Selection selection = selection_of(store.metadata(), detail, themes);
  const RaisedIndex index(store, selection);
  return retrieve_section(index, selection, SectionLine(store.metadata().grid, from, to), progress);
}

}  // namespace itin
