#include "features/feature_lines.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <itin/sort_unique.hpp>

#include "features/feature_outlines.hpp"
#include "features/plan/hot_pixel.hpp"
#include "geometry/predicates.hpp"
#include "store/segments/edge_quadtree.hpp"
#include "store/store_file.hpp"
#include "topology/joined_lines.hpp"
#include "triangulate/apex/selection.hpp"
#include "triangulate/region/grid_window.hpp"

namespace itin {

namespace {

/// The theme number by which edges differ from the segments that they may lie on.
constexpr std::uint16_t kEdge = 0;

/// A theme's edges that meet the window, and the segments that they are pieces of.
class ThemeEdges {
 public:
  ThemeEdges(const Tin& tin, const GridWindow& window, std::uint16_t theme) : tin_(tin), theme_(theme) {
    for (const LineEdge& e : tin_.lines) {
      const GridPoint &a = tin_.vertices[e.from], &b = tin_.vertices[e.to];
      if (e.theme != theme || !window.meets(a, b, b)) continue;
      ends_.emplace(Segment{a.x, a.y, b.x, b.y, kEdge}, LineEnds{e.from, e.to});
      box_.extend(a.x, a.y);
      box_.extend(b.x, b.y);
    }
  }

  /// The edges of each feature. An edge belongs to the features of the segment that it lies on, which a vertex of the
  /// terrain may split.
  std::map<std::optional<std::uint32_t>, std::vector<LineEnds>> by_feature(const Store& store,
                                                                           const Selection& selection) const {
    const std::vector<SegmentFeature> features = selected_features(store, selection);
    std::vector<Segment> all;
    for (const auto& [edge, ends] : ends_) all.push_back(edge);
    for (const SegmentFeature& f : features) all.push_back(f.segment);
    std::map<Segment, std::vector<std::uint32_t>> of_edge;
    for_each_edge_leaf(std::move(all), [&](const Cell&, const std::vector<Segment>& near) {
      for (const Segment& edge : near) {
        if (edge.theme != kEdge) continue;
        for (const Segment& s : near)
          if (s.theme != kEdge && lies_on(edge, s))
            for (const SegmentFeature& f : of_segment(features, s)) of_edge[edge].push_back(f.feature);
      }
    });
    std::map<std::optional<std::uint32_t>, std::vector<LineEnds>> result;
    for (const auto& [edge, ends] : ends_) {
      const auto found = of_edge.find(edge);
      if (found == of_edge.end()) {
        result[std::nullopt].push_back(ends);
        continue;
      }
      std::vector<std::uint32_t>& numbers = found->second;
      sort_unique(numbers);
      for (const std::uint32_t feature : numbers) result[feature].push_back(ends);
    }
    return result;
  }

 private:
  std::vector<SegmentFeature> selected_features(const Store& store, const Selection& selection) const {
    std::vector<SegmentFeature> features;
    if (!box_.empty()) file_of(store).segment_features(theme_, box_, features);
    std::erase_if(features, [&](const SegmentFeature& f) { return !selection.selects(f.segment); });
    sort_unique(features);
    return features;
  }

  static bool lies_on(const Segment& edge, const Segment& s) {
    const Position a = s.a(), b = s.b();
    return on_segment(a, b, edge.a()) && on_segment(a, b, edge.b());
  }

  const Tin& tin_;
  std::uint16_t theme_;
  std::map<Segment, LineEnds> ends_;
  GridBox box_;
};

}  // namespace

std::vector<FeatureLine> feature_lines(const Store& store, const WindowLines& lines, Progress& progress) {
  const StoreMetadata& metadata = store.metadata();
  const GridWindow window(lines.window, metadata.grid, metadata.bounds);
  const Selection selection = selection_of(metadata, lines.detail, ThemeChoice::all().with_ground_lines());
  std::vector<FeatureLine> found;
  for (const std::uint16_t theme : lines.themes) {
    progress.throw_if_cancelled();
    if (metadata.themes[theme - std::size_t{1}].is_raised()) {
      for (FeatureLine& line : feature_outlines(store, lines, theme, progress)) found.push_back(std::move(line));
      continue;
    }
    for (const auto& [feature, edges] : ThemeEdges(lines.tin, window, theme).by_feature(store, selection)) {
      for (const JoinedLine& joined : joined_lines(edges)) {
        FeatureLine& line = found.emplace_back(FeatureLine{theme, feature, {}});
        for (const std::uint32_t v : joined.vertices) line.points.push_back(lines.tin.point(v));
      }
    }
  }
  return found;
}

}  // namespace itin
