#include "import/stored_sources.hpp"

#include <algorithm>

#include "pyramid/pyramid.hpp"
#include "store/codec/point_index.hpp"
#include "store/set_aside.hpp"
#include "store/store_file.hpp"

namespace itin {

namespace {

/// Adds the points of the surface that are neither from lines nor inferred.
void add_surface(const Store& store, PointIntake& intake, LineCollection& lines, StoredPoints& stored,
                 Progress& progress) {
  const std::size_t inferred = imported_sources(&store).size();
  std::vector<Leaf> leaves;
  store.points().leaves({}, store.points().bounds(), leaves);
  std::vector<RawPoint> points;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    progress.throw_if_cancelled();
    if (leaves[i].theme > store.metadata().themes.size()) continue;  // a part's leaf, and parts are made again
    const auto block = store.points().block(leaves[i]);
    points.clear();
    for (std::size_t k = 0; k < block->points.size(); ++k) {
      const GridPoint& p = block->points[k];
      if (block->sources[k] == inferred)
        stored.inferred.push_back(p);
      else if (!lines.take_vertex(p, block->sources[k], leaves[i].theme == 0))
        points.push_back({code_of(p), p.z, block->sources[k], 0});
    }
    intake.add(points);
    stored.count += points.size();
    progress.report("reading the store", static_cast<double>(i + 1) / static_cast<double>(leaves.size()));
  }
}

void add_set_aside(const StoreRows& rows, PointIntake& intake, StoredPoints& stored, Progress& progress) {
  const std::uint32_t blocks = set_aside_list(rows).point_blocks;
  for (std::uint32_t i = 0; i < blocks; ++i) {
    progress.throw_if_cancelled();
    const Block block = set_aside_points(rows, i);
    for (std::size_t k = 0; k < block.points.size(); ++k)
      intake.add({code_of(block.points[k]), block.points[k].z, block.sources[k], 0});
    stored.count += block.points.size();
  }
}

bool has_contours(const Store& store) {
  const std::vector<ThemeInfo>& themes = store.metadata().themes;
  return std::any_of(themes.begin(), themes.end(), [](const auto& t) { return t.kind == ThemeKind::Contours; });
}

}  // namespace

bool repairs(const Store* store) {
  return store != nullptr && !store->metadata().sources.empty() && store->metadata().sources.back().kind == kInferred;
}

bool will_repair(const ImportOptions& options, const Store* store) {
  if (options.kind != ThemeKind::Contours) return repairs(store);
  return options.repair && (store == nullptr || !has_contours(*store) || repairs(store));
}

std::vector<SourceInfo> imported_sources(const Store* store) {
  if (store == nullptr) return {};
  std::vector<SourceInfo> sources = store->metadata().sources;
  if (repairs(store)) sources.pop_back();
  return sources;
}

StoredPoints add_stored_ground(const Store& store, PointIntake& intake, LineCollection& lines, Progress& progress) {
  const StoreRows& rows = file_of(store).rows();
  StoredPoints stored;
  lines.take_segments(store);
  add_surface(store, intake, lines, stored, progress);
  add_set_aside(rows, intake, stored, progress);
  lines.take_set_aside(rows);
  std::sort(stored.inferred.begin(), stored.inferred.end(),
            [](const GridPoint& a, const GridPoint& b) { return code_of(a) < code_of(b); });
  return stored;
}

}  // namespace itin
