#include "pyramid/levels/certify.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include <itin/box_of.hpp>
#include <itin/call_progress.hpp>
#include <itin/error.hpp>
#include <itin/parallel.hpp>
#include <itin/sort_unique.hpp>

#include "pyramid/levels/cell_verification.hpp"
#include "pyramid/levels/changed_by_lines.hpp"
#include "pyramid/levels/fine_bounds.hpp"
#include "pyramid/levels/whole_levels.hpp"
#include "triangulate/mesh/triangle_box.hpp"

namespace itin {

namespace {

/// The most points of a cell in rounds that measure without mending.
constexpr std::uint32_t kFirstCell = 1 << 15;
/// With this many lines per leaf or more, verifying everything again takes no longer than finding what the lines
/// changed.
constexpr double kManyLines = 0.25;

/// Which levels of which leaves must be verified again.
class Disturbed {
 public:
  explicit Disturbed(std::size_t leaves) : levels_(leaves) {}

  void mark(std::uint32_t leaf, unsigned levels) { levels_[leaf].fetch_or(levels, std::memory_order_relaxed); }
  /// The part of the cell to verify at these levels: the least box around the marked leaves, perhaps empty.
  Task in(const WorkingIndex& index, const CurveRange& cell, unsigned levels) const {
    Task task{cell, {}, 0};
    for (std::uint32_t leaf = index.leaf_of(cell.cell.code);
         leaf < levels_.size() && index.ranges()[leaf].cell.code < cell.cell.end(); ++leaf) {
      const unsigned todo = levels_[leaf].load(std::memory_order_relaxed) & levels;
      if (todo == 0) continue;
      task.levels |= todo;
      const GridBox square = square_of(index.ranges()[leaf].cell);
      task.box.extend(square.xmin, square.ymin);
      task.box.extend(square.xmax, square.ymax);
    }
    return task;
  }
  void clear() {
    for (auto& l : levels_) l.store(0, std::memory_order_relaxed);
  }

 private:
  std::vector<std::atomic<unsigned>> levels_;
};

/// A cell, and the levels that are verified in it together.
struct CellLevels {
  CurveRange cell;
  unsigned levels;
};

std::vector<CellLevels> cells_to_measure(const WorkingIndex& index) {
  std::vector<CellLevels> cells;
  for (const CurveRange& cell : index.tiles(kFirstCell)) cells.push_back({cell, ~0u});
  return cells;
}

std::vector<CellLevels> cells_to_mend(const WorkingIndex& index) {
  std::map<Cell, CellLevels> cells;
  for (int k = 1; k < index.level_count(); ++k) {
    for (const CurveRange& cell : index.mending_cells(k))
      cells.try_emplace(cell.cell, CellLevels{cell, 0}).first->second.levels |= 1u << k;
  }
  std::vector<CellLevels> result;
  for (const auto& [place, cell] : cells) result.push_back(cell);
  return result;
}

std::vector<Task> disturbed_cells(const WorkingIndex& index, const std::vector<CellLevels>& cells,
                                  const Disturbed& disturbed) {
  std::vector<Task> tasks;
  for (const auto& [cell, levels] : cells) {
    const Task task = disturbed.in(index, cell, levels);
    if (task.levels != 0) tasks.push_back(task);
  }
  return tasks;
}

unsigned levels_of_tasks(const std::vector<Task>& tasks) {
  return std::accumulate(tasks.begin(), tasks.end(), 0U, [](unsigned all, const Task& t) { return all | t.levels; });
}

struct Raise {
  RaisedPoint point;
  Task by;  ///< the task whose bounds take it into account
};

/// Appends the leaves whose squares meet a triangle. The box of a long one, as across the sea, meets far more.
void leaves_under(const WorkingIndex& index, const std::array<Position, 3>& corners,
                  std::vector<std::uint32_t>& leaves) {
  const auto first = static_cast<std::ptrdiff_t>(leaves.size());
  index.leaves_at(box_of(corners), leaves);
  leaves.erase(std::remove_if(
                   leaves.begin() + first, leaves.end(),
                   [&](std::uint32_t leaf) { return !triangle_meets(corners, square_of(index.ranges()[leaf].cell)); }),
               leaves.end());
}

/// A raised vertex changes the surface within its star, for every level it newly belongs to.
void mark_star(const WorkingIndex& index, const std::vector<std::int32_t>& tolerances, const Raise& raise,
               Disturbed& disturbed) {
  const Position p = position_of(raise.point.code);
  std::vector<std::uint32_t> leaves;
  for (int k = raise.point.from + 1; k <= raise.point.to; ++k) {
    leaves.clear();
    const RegionMesh star = triangulate_region(index, levels_from(k, tolerances), {p.x, p.y, p.x, p.y});
    for (std::uint32_t t = 0; t < star.mesh.triangles.size(); ++t) leaves_under(index, star.corners(t), leaves);
    sort_unique(leaves);
    for (const std::uint32_t leaf : leaves) {
      const bool known = (raise.by.levels >> k & 1) && raise.by.covers(index.ranges()[leaf].cell);
      if (!known) disturbed.mark(leaf, 1u << k);
    }
  }
}

/// Marks where lines that were put back change the surface; nearly everything, if they are many.
void mark_lines(const WorkingIndex& index, const std::vector<std::int32_t>& tolerances,
                const std::vector<LineHierarchy::Restored>& lines, Disturbed& disturbed) {
  struct Neighbours {
    int level;
    std::vector<GridBox> lines;
  };
  std::vector<Neighbours> groups;
  for (int k = 1; k < index.level_count(); ++k) {
    std::vector<GridBox> boxes;
    for (const LineHierarchy::Restored& r : lines)
      if (r.finest <= k && k <= r.coarsest) boxes.push_back(r.box);
    if (boxes.size() > kManyLines * static_cast<double>(index.ranges().size())) {
      for (std::uint32_t leaf = 0; leaf < index.ranges().size(); ++leaf) disturbed.mark(leaf, 1u << k);
      continue;
    }
    std::map<std::uint32_t, std::vector<GridBox>> by_leaf;
    for (const GridBox& box : boxes) by_leaf[index.leaf_of(morton(box.xmin, box.ymin))].push_back(box);
    for (auto& [leaf, near] : by_leaf) groups.push_back({k, std::move(near)});
  }
  parallel_for(groups.size(), [&](std::size_t i) {
    std::vector<std::uint32_t> leaves;
    for (const GridBox& box : changed_by_lines(index, levels_from(groups[i].level, tolerances), groups[i].lines))
      index.leaves_at(box, leaves);
    for (const std::uint32_t leaf : leaves) disturbed.mark(leaf, 1u << groups[i].level);
  });
}

/// Writes a cell's raised levels to the index, and notes what is new.
void apply(const RaisedLevels& raised, const Task& task, WorkingIndex& index, std::vector<Raise>& raises) {
  if (raised.empty()) return;
  std::vector<RawPoint> points = index.read(task.cell);
  for (RawPoint& p : points) {
    const auto found = raised.find(p.code);
    if (found == raised.end() || found->second <= p.level) continue;
    raises.push_back({{p.code, p.level, found->second}, task});
    p.level = static_cast<std::uint16_t>(found->second);
  }
  index.write(task.cell, points);
}

/// Raises what the hierarchy needs with these raises, and notes it with them.
void close_levels(WorkingIndex& index, const PostHierarchy& posts, std::vector<Raise>& raises) {
  std::vector<LevelRaise> raised;
  for (const Raise& raise : raises) raised.push_back({raise.point.code, raise.point.to});
  for (const RaisedPoint& point : index.promote(posts.closing(raised))) raises.push_back({point, {}});
}

/// Marks the leaves that fail, and returns whether there are any.
bool mark_failures(const LeafBounds& bounds, const std::vector<std::int32_t>& tolerances, std::size_t leaves,
                   Disturbed& disturbed) {
  bool any = false;
  for (std::uint32_t leaf = 0; leaf < leaves; ++leaf) {
    for (std::size_t k = 1; k < tolerances.size(); ++k) {
      if (bounds.at(leaf, static_cast<int>(k)).size() <= tolerances[k]) continue;
      disturbed.mark(leaf, 1u << k);
      any = true;
    }
  }
  return any;
}

std::vector<LineHierarchy::Shortcut> failing_shortcuts(const std::vector<CellOutcome>& outcomes) {
  std::vector<LineHierarchy::Shortcut> result;
  for (const CellOutcome& outcome : outcomes)
    result.insert(result.end(), outcome.failing.begin(), outcome.failing.end());
  sort_unique(result);
  return result;
}

/// The share of the time that a round takes which looks at everything. Where coarse triangles are long, mending takes
/// longer.
constexpr double kFirstRound = 0.6, kFirstRoundOfLong = 0.3;
/// The share of the time that fine levels of rasters take before that.
constexpr double kFineLevels = 0.15;

}  // namespace

LeafBounds certify(WorkingIndex& index, const std::vector<std::int32_t>& tolerances, const PostHierarchy& posts,
                   bool long_triangles, const RestoreLines& restore, Progress& progress) {
  index.keep_coarse_points();
  const int levels = static_cast<int>(tolerances.size());
  LeafBounds bounds(index.ranges().size(), levels);
  CallProgress call(progress);
  Disturbed disturbed(index.ranges().size());
  const std::vector<unsigned> known =
      measure_fine_levels(index, index.work_cells(), posts, bounds, call.step(kFineLevels));
  for (std::uint32_t leaf = 0; leaf < index.ranges().size(); ++leaf)
    disturbed.mark(leaf, ((1u << levels) - 2) & ~known[leaf]);

  bool mend = false;    // points are raised once no shortcut is too far off along itself
  bool changed = true;  // since all failing leaves were marked
  while (true) {
    const std::vector<Task> tasks =
        disturbed_cells(index, mend ? cells_to_mend(index) : cells_to_measure(index), disturbed);
    if (tasks.empty()) {
      if (!mark_failures(bounds, tolerances, index.ranges().size(), disturbed)) return bounds;
      // A store that promises what does not hold must not be written.
      if (!changed)
        throw Error("a level could not be brought within its tolerance; nothing was written; please report this");
      mend = true;
      changed = false;
      continue;
    }
    disturbed.clear();
    call.step(mend ? 0.5 : long_triangles ? kFirstRoundOfLong : kFirstRound);

    std::optional<WholeLevels> whole;
    if (long_triangles && !mend) whole.emplace(index, tolerances, levels_of_tasks(tasks));
    std::vector<CellOutcome> outcomes(tasks.size());
    std::atomic<std::size_t> done = 0;
    parallel_for(tasks.size(), [&](std::size_t i) {
      progress.throw_if_cancelled();
      outcomes[i] = verify_cell(index, tolerances, tasks[i], mend, whole ? &*whole : nullptr, bounds);
      const double share = static_cast<double>(++done) / static_cast<double>(tasks.size());
      call.report(mend ? "mending the levels" : "verifying the levels", share);
    });

    std::vector<Raise> raises;
    for (std::size_t i = 0; i < tasks.size(); ++i) apply(outcomes[i].raised, tasks[i], index, raises);
    close_levels(index, posts, raises);
    const std::vector<LineHierarchy::Shortcut> shortcuts = failing_shortcuts(outcomes);
    std::vector<LineHierarchy::Restored> lines;
    if (!shortcuts.empty()) lines = restore(shortcuts);
    changed = changed || !raises.empty() || !lines.empty();
    mend = mend || lines.empty();

    parallel_for(raises.size(), [&](std::size_t i) { mark_star(index, tolerances, raises[i], disturbed); });
    mark_lines(index, tolerances, lines, disturbed);
    for (const CellOutcome& outcome : outcomes) {
      for (const auto& [code, level] : outcome.left_to_others) disturbed.mark(index.leaf_of(code), 1u << level);
    }
  }
}

}  // namespace itin
