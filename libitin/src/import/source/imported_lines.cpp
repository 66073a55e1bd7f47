#include "import/source/imported_lines.hpp"

#include <algorithm>

#include "geometry/predicates.hpp"

namespace itin {

namespace {

/// A segment's ends alone, in order.
Segment plan_of(const Segment& s) {
  const auto [a, b] = std::minmax({s.a(), s.b()});
  return {a.x, a.y, b.x, b.y};
}
Segment plan_of(const ImportedSegment& s) {
  return {s.a.x, s.a.y, s.b.x, s.b.y};
}

/// Whether an end of a line of the terrain still has the height and the source that it was imported with.
bool is_as_it_came(const GridPoint& p, std::uint16_t source, const ThemeLines& lines) {
  const std::vector<GridPoint>& vertices = lines.lines.vertices;
  const auto at = find_by_code(vertices, code_of(p));
  return *at == p && lines.sources[static_cast<std::size_t>(at - vertices.begin())] == source;
}

/// A theme's segments, each of which may be one that was imported.
class Placed {
 public:
  void add(const Segment& s) { plans_.push_back(plan_of(s)); }
  void add(const SegmentFeature& f) { features_.push_back({plan_of(f.segment), f.feature}); }
  void finish() {
    std::sort(plans_.begin(), plans_.end());
    std::sort(features_.begin(), features_.end());
    came_.resize(plans_.size());
  }
  /// Takes a segment with these ends if there is one that is not taken yet, is of this feature and no other, and for
  /// which came() is true. Returns whether one was taken.
  template <class Came>
  bool take_if(const ImportedSegment& s, const Came& came) {
    const auto at = std::lower_bound(plans_.begin(), plans_.end(), plan_of(s));
    const auto number = static_cast<std::size_t>(at - plans_.begin());
    if (at == plans_.end() || *at != plan_of(s) || came_[number] || !is_of_one(*at, s.feature) || !came()) return false;
    return came_[number] = true;
  }
  std::vector<Segment> not_taken() const {
    std::vector<Segment> made;
    for (std::size_t i = 0; i < plans_.size(); ++i)
      if (!came_[i]) made.push_back(plans_[i]);
    return made;
  }

 private:
  /// Whether a segment belongs to this feature alone. The store tells the features of a segment, but not which of them
  /// it came with.
  bool is_of_one(const Segment& plan, std::uint32_t feature) const {
    const auto own = of_segment(features_, plan);
    if (own.empty()) return feature == kNoFeature;
    return own.size() == 1 && own.front().feature == feature;
  }

  std::vector<Segment> plans_;            ///< ascending
  std::vector<SegmentFeature> features_;  ///< ascending
  std::vector<bool> came_;
};

}  // namespace

std::vector<ImportedPiece> imported_pieces(const StoreRows& rows, std::size_t themes,
                                           const std::vector<Segment>& stored,
                                           const std::function<ImportedSegment(const Segment&)>& with_heights) {
  const SetAsideList list = set_aside_list(rows);
  std::vector<ImportedPiece> pieces;
  std::vector<std::vector<Segment>> made(themes);
  for (std::uint32_t theme = 0; theme < themes; ++theme) {
    const auto number = static_cast<std::uint16_t>(theme + 1);
    for (std::uint32_t i = 0; i < list.blocks_of(number); ++i) {
      const SetAsideLines lines = set_aside_lines(rows, number, i);
      made[theme].insert(made[theme].end(), lines.made.begin(), lines.made.end());
      for (const ImportedSegment& s : lines.imported) pieces.push_back({theme, s});
    }
  }
  for (const Segment& s : stored) {
    const auto theme = static_cast<std::uint32_t>(s.theme - 1);
    if (!std::binary_search(made[theme].begin(), made[theme].end(), plan_of(s)))
      pieces.push_back({theme, with_heights(s)});
  }
  return pieces;
}

std::vector<SetAsideLines> set_aside_of(std::span<const ImportedPiece> pieces, const std::vector<Segment>& placed,
                                        const std::vector<SegmentFeature>& features, const ThemeLines& lines) {
  std::vector<Placed> of_theme(lines.themes());
  for (const Segment& s : placed) of_theme[s.theme - std::size_t{1}].add(s);
  for (const SegmentFeature& f : features) of_theme[f.segment.theme - std::size_t{1}].add(f);
  for (Placed& p : of_theme) p.finish();
  std::vector<SetAsideLines> result(lines.themes());
  for (const ImportedPiece& piece : pieces) {
    const ImportedSegment& s = piece.segment;
    // A piece that is not placed may have ends that are no vertices, so came() is asked for placed ones only.
    const auto came = [&] {
      return !lines.terrain[piece.theme] ||
             (is_as_it_came(s.a, s.source, lines) && is_as_it_came(s.b, s.source, lines));
    };
    if (!of_theme[piece.theme].take_if(s, came)) result[piece.theme].imported.push_back(s);
  }
  for (std::size_t t = 0; t < result.size(); ++t) result[t].made = of_theme[t].not_taken();
  return result;
}

}  // namespace itin
