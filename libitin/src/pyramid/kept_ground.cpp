#include "pyramid/kept_ground.hpp"

#include <algorithm>
#include <utility>

#include <itin/call_progress.hpp>
#include <itin/precondition.hpp>
#include <itin/sort_unique.hpp>

#include "pyramid/line_writer.hpp"
#include "store/set_aside.hpp"
#include "store/store_file.hpp"

namespace itin {

namespace {

/// A store's ground without the features on it, and with no lines but its outline.
class BareGround final : public PointIndex {
 public:
  explicit BareGround(const Store& store) : points_(store.points()) {}

  int level_count() const override { return points_.level_count(); }
  GridBox bounds() const override { return points_.bounds(); }
  void leaves(const LevelRange& asked, const GridBox& box, std::vector<Leaf>& out) const override {
    std::vector<Leaf> all;
    points_.leaves(asked, box, all);
    std::copy_if(all.begin(), all.end(), std::back_inserter(out), [](const Leaf& leaf) { return leaf.theme == 0; });
  }
  std::shared_ptr<const Block> block(const Leaf& leaf) const override { return points_.block(leaf); }
  std::shared_ptr<const Block> unordered_block(const Leaf& leaf) const override {
    return points_.unordered_block(leaf);
  }
  std::shared_ptr<const Block> block_once(const Leaf& leaf) const override { return points_.block_once(leaf); }
  std::shared_ptr<const Block> plan_once(const Leaf& leaf) const override { return points_.plan_once(leaf); }
  PostLattice lattice_of(const Leaf& leaf) const override { return points_.lattice_of(leaf); }
  std::optional<PostHeights> posts_once(const Leaf& leaf) const override { return points_.posts_once(leaf); }
  void segments(const GridBox& box, std::vector<Segment>& out) const override { points_.outline(box, out); }
  void outline(const GridBox& box, std::vector<Segment>& out) const override { points_.outline(box, out); }

 private:
  const PointIndex& points_;
};

}  // namespace

bool may_keep_ground(const StoreMetadata& metadata) {
  return std::all_of(metadata.themes.begin(), metadata.themes.end(),
                     [](const ThemeInfo& theme) { return theme.is_raised(); });
}

PyramidReport keep_ground(const Store& store, const std::vector<SourceInfo>& sources, const ThemeLines& lines,
                          StoreWriter& writer, Progress& progress) {
  ITIN_PRECONDITION(may_keep_ground(store.metadata()) && lines.empty());
  CallProgress call(progress);
  const BareGround ground(store);
  std::vector<Segment> outline;
  ground.outline(ground.bounds(), outline);
  sort_unique(outline);
  constexpr double kCopying = 0.8;
  writer.take_ground(store, outline, call.step(kCopying));
  PyramidReport report;
  for (const SourceInfo& source : sources)
    report.vertices_of_source.push_back(source.theme.empty() ? source.vertices : 0);
  const SetAsideCounts set_aside = set_aside_list(file_of(store).rows()).counts;
  report.replaced = set_aside.replaced, report.isolated = set_aside.isolated;
  PlacedLines placed;
  placed.raised = raised_segments(lines);
  placed.ground = ground_segments(lines);
  LineWriter(lines, placed, ground, writer, report).run(std::move(outline), {}, call.step(1));
  writer.take_points_set_aside(store);
  return report;
}

}  // namespace itin
