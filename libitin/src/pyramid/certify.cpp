#include "pyramid/certify.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>

#include <itin/box_of.hpp>
#include <itin/call_progress.hpp>
#include <itin/detail.hpp>
#include <itin/error.hpp>
#include <itin/parallel.hpp>

#include "pyramid/lattice_difference.hpp"
#include "triangulate/read_once.hpp"

namespace itin {

namespace {

/// Points a cell of the first round, which only looks.
constexpr std::uint32_t kFirstCell = 1 << 15;
/// A cell of the later rounds, which mend where a level does not hold, has about so many of the level's points. The
/// full surface under it has to be made anew, so it is no larger than it must be.
constexpr double kLevelPoints = 128;
constexpr std::uint32_t kLeastCell = 1 << 11, kGreatestCell = 1 << 15;

using Levels = std::unordered_map<std::uint64_t, int>;  ///< by Morton code

/// The index, with some points raised.
class RaisedIndex final : public PointIndex {
 public:
  RaisedIndex(const PointIndex& base, const Levels& raised) : base_(base), raised_(raised) {
    for (const auto& [code, level] : raised) {
      const std::int32_t x = morton_x(code), y = morton_y(code);
      base.leaves(0, {x, y, x, y}, leaves_);
    }
    std::sort(leaves_.begin(), leaves_.end(), before);
    const auto same = [](const Leaf& a, const Leaf& b) { return a.cell == b.cell; };
    leaves_.erase(std::unique(leaves_.begin(), leaves_.end(), same), leaves_.end());
  }

  int level_count() const override { return base_.level_count(); }
  GridBox bounds() const override { return base_.bounds(); }
  void leaves(int finest, const GridBox& box, std::vector<Leaf>& out) const override {
    const auto first = static_cast<std::ptrdiff_t>(out.size());
    base_.leaves(finest, box, out);
    out.erase(std::remove_if(out.begin() + first, out.end(), [&](const Leaf& leaf) { return any_raised(leaf); }),
              out.end());
    // They may hold points of this level only now.
    std::copy_if(leaves_.begin(), leaves_.end(), std::back_inserter(out),
                 [&](const Leaf& leaf) { return leaf.cell.box().meets(box); });
  }
  std::shared_ptr<const Block> block(const Leaf& leaf) const override {
    auto block = base_.block(leaf);
    if (!any_raised(leaf)) return block;
    auto copy = std::make_shared<Block>(*block);
    for (std::size_t i = 0; i < copy->points.size(); ++i) {
      const auto found = raised_.find(morton(copy->points[i].x, copy->points[i].y));
      if (found != raised_.end()) copy->levels[i] = std::max(copy->levels[i], static_cast<std::uint8_t>(found->second));
    }
    return copy;
  }
  void segments(const GridBox& box, std::vector<Segment>& out) const override { base_.segments(box, out); }

 private:
  static bool before(const Leaf& a, const Leaf& b) { return a.cell < b.cell; }
  bool any_raised(const Leaf& leaf) const { return std::binary_search(leaves_.begin(), leaves_.end(), leaf, before); }

  const PointIndex& base_;
  const Levels& raised_;
  std::vector<Leaf> leaves_;  ///< with raised points, along the curve
};

/// Selects level k and coarser.
Selection levels_from(int k, const std::vector<std::int32_t>& tolerances) {
  const std::vector<double> metres(tolerances.begin(), tolerances.end());
  return Selection(Detail::tolerance(metres[static_cast<std::size_t>(k)]), metres, Grid{});
}

/// A task of verification: those leaves of the cell that lie in the box, for these levels.
struct Task {
  CurveRange cell;
  GridBox box;
  unsigned levels;

  bool covers(const Cell& leaf) const { return cell.cell.contains(leaf) && box.contains(square_of(leaf)); }
};

struct CellOutcome {
  Levels raised;
  /// Points of other cells, with levels, that would mend what still fails here. Their cells see the same failure.
  std::vector<std::pair<std::uint64_t, int>> left_to_others;
};

/// Verifies leaves of one cell.
class CellVerification {
 public:
  CellVerification(const WorkingIndex& index, const std::vector<std::int32_t>& tolerances, const Task& task)
      : index_(index), points_(index), tolerances_(tolerances), task_(task) {}

  /// Replaces the leaves' bounds. If `mend`, points of the cell are raised until the levels hold in the box.
  CellOutcome run(bool mend, LeafBounds& bounds) {
    if (auto posts = WholeLattice::about(points_, task_.box)) lattice_.emplace(std::move(*posts));
    for (int k = static_cast<int>(tolerances_.size()) - 1; k >= 1; --k) {
      if (!(task_.levels >> k & 1)) continue;
      for_each_leaf([&](std::uint32_t leaf) { bounds.at(leaf, k) = {}; });
      if (lattice_ || make_mesh()) verify(k, mend, bounds);
    }
    return {std::move(raised_), std::move(left_to_others_)};
  }

 private:
  void verify(int k, bool mend, LeafBounds& bounds) {
    const std::int32_t tolerance = tolerances_[static_cast<std::size_t>(k)];
    while (true) {
      const RaisedIndex raised(points_, raised_);
      const RegionMesh coarse =
          triangulate_region(raised, levels_from(k, tolerances_),
                             lattice_ ? lattice_->posts().bounds() : box_of(fine_.vertices, &SelectedVertex::point));
      // What fails is mended by triangles.
      if (lattice_ && lattice_->compare(coarse) && (!mend || lattice_->whole().size() <= tolerance)) {
        forget_left(k);
        return record(k, *lattice_, bounds);
      }
      make_mesh();
      const Difference d = difference(fine_, *edges_, coarse, tolerance);
      if (!mend || !raise(k, d)) return record(k, d, bounds);
    }
  }

  /// Returns whether there is any ground.
  bool make_mesh() {
    if (edges_ != nullptr) return true;
    fine_ = triangulate_region(points_, levels_from(0, tolerances_), task_.box);
    if (fine_.mesh.triangles.empty()) return false;
    edges_ = std::make_unique<FineEdges>(fine_);
    find_leaves();
    return true;
  }

  std::uint64_t code(std::uint32_t v) const { return morton(fine_.vertices[v].point.x, fine_.vertices[v].point.y); }

  /// Raises, if it is the cell's own, the worst point of each coarse face and what breaks up each coarse edge that is
  /// more than the tolerance off. True when there was any.
  bool raise(int k, const Difference& d) {
    bool any = false;
    forget_left(k);
    const auto raise_own = [&](std::uint32_t v) {
      if (!task_.cell.cell.contains(code(v))) {
        left_to_others_.emplace_back(code(v), k);
        return;
      }
      raised_[code(v)] = k;
      any = true;
    };
    for (const std::uint32_t v : worst_by_face(d, tolerances_[static_cast<std::size_t>(k)])) raise_own(v);
    for (const std::uint32_t v : remedies(d)) raise_own(v);
    return any;
  }

  void forget_left(int k) {
    std::erase_if(left_to_others_, [&](const auto& p) { return p.second == k; });
  }

  static std::vector<std::uint32_t> worst_by_face(const Difference& d, std::int32_t tolerance) {
    std::unordered_map<std::uint32_t, std::uint32_t> worst;
    std::vector<std::uint32_t> faces;
    for (std::uint32_t v = 0; v < d.at_vertex.size(); ++v) {
      if (d.at_vertex[v].size() <= tolerance) continue;
      const auto [at, fresh] = worst.try_emplace(d.face[v], v);
      if (fresh) faces.push_back(d.face[v]);
      if (d.at_vertex[v].size() > d.at_vertex[at->second].size()) at->second = v;
    }
    std::vector<std::uint32_t> result;
    for (const std::uint32_t face : faces) result.push_back(worst[face]);
    return result;
  }

  /// The point that breaks up each coarse edge at the place where it is most off, among those where any point does.
  /// Ties go to the first place by its ends' codes: cells that leave points to each other agree on them, or none would
  /// ever raise any.
  std::vector<std::uint32_t> remedies(const Difference& d) const {
    std::vector<Difference::Crossing> crossings = d.too_large;
    const auto coarse_edge = [](const Difference::Crossing& c) { return std::pair(c.coarse_from, c.coarse_to); };
    const auto key = [&](const Difference::Crossing& c) {
      const FineEdges::Edge& edge = edges_->edges()[c.fine_edge];
      return std::tuple(coarse_edge(c), -c.size, std::min(edge.u, edge.v), std::max(edge.u, edge.v));
    };
    std::sort(crossings.begin(), crossings.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
    std::vector<std::uint32_t> result;
    std::optional<std::pair<std::uint32_t, std::uint32_t>> mended;
    for (const Difference::Crossing& c : crossings) {
      if (mended == coarse_edge(c)) continue;
      const auto v = remedy(c, d);
      if (!v) continue;
      result.push_back(*v);
      mended = coarse_edge(c);
    }
    return result;
  }

  /// The fine edge's nearer end, or the other one, or a corner opposite: the first that is not in the coarse surface
  /// yet. There is one, or both fine triangles would be coarse ones as well, unless lines differ.
  std::optional<std::uint32_t> remedy(const Difference::Crossing& c, const Difference& d) const {
    const FineEdges::Edge& edge = edges_->edges()[c.fine_edge];
    for (const std::uint32_t v : {c.nearer_u ? edge.u : edge.v, c.nearer_u ? edge.v : edge.u}) {
      if (!d.is_coarse_vertex[v]) return v;
    }
    for (const std::uint32_t t : {edge.triangle, edge.other}) {
      if (t == kNoTriangle) continue;
      for (const std::uint32_t v : fine_.mesh.triangles[t]) {
        if (!d.is_coarse_vertex[v]) return v;
      }
    }
    return std::nullopt;
  }

  template <class Visit>
  void for_each_leaf(const Visit& visit) const {
    const auto& ranges = index_.ranges();
    for (std::uint32_t leaf = index_.leaf_of(task_.cell.cell.code);
         leaf < ranges.size() && ranges[leaf].cell.code < task_.cell.cell.end(); ++leaf) {
      if (task_.covers(ranges[leaf].cell)) visit(leaf);
    }
  }

  void record(int k, const LatticeDifference& d, LeafBounds& bounds) const {
    for_each_leaf([&](std::uint32_t leaf) { bounds.at(leaf, k).add(d.over(square_of(index_.ranges()[leaf].cell))); });
  }

  /// Every leaf that a fine triangle may meet takes the triangle's range.
  void record(int k, const Difference& d, LeafBounds& bounds) const {
    const std::vector<DifferenceRange> of_triangle = over_triangles(fine_, *edges_, d);
    for (const auto& [t, leaf] : triangles_of_leaves_) bounds.at(leaf, k).add(of_triangle[t]);
  }

  /// Which of the leaves each fine triangle may meet.
  void find_leaves() {
    std::vector<std::uint32_t> leaves;
    for (std::uint32_t t = 0; t < fine_.mesh.triangles.size(); ++t) {
      GridBox box;
      for (const std::uint32_t v : fine_.mesh.triangles[t])
        box.extend(fine_.vertices[v].point.x, fine_.vertices[v].point.y);
      leaves.clear();
      index_.leaves_at(box, leaves);
      for (const std::uint32_t leaf : leaves) {
        if (task_.covers(index_.ranges()[leaf].cell)) triangles_of_leaves_.emplace_back(t, leaf);
      }
    }
  }

  const WorkingIndex& index_;
  const ReadOnce points_;  ///< those of the index
  const std::vector<std::int32_t>& tolerances_;
  Task task_;
  std::optional<LatticeDifference> lattice_;  ///< where the full surface is a lattice
  RegionMesh fine_;                           ///< else, and where a level fails
  std::unique_ptr<FineEdges> edges_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> triangles_of_leaves_;
  Levels raised_;
  std::vector<std::pair<std::uint64_t, int>> left_to_others_;
};

/// Which levels of which leaves must be verified again.
class Disturbed {
 public:
  explicit Disturbed(std::size_t leaves) : levels_(leaves) {}

  void mark(std::uint32_t leaf, unsigned levels) { levels_[leaf].fetch_or(levels, std::memory_order_relaxed); }
  /// The part of these levels that must be verified in the cell: the least box around it, perhaps empty.
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

/// Cells of this size for these levels.
struct Tiling {
  std::uint32_t capacity;
  unsigned levels;
};

std::vector<Tiling> tilings(const WorkingIndex& index) {
  std::vector<Tiling> result;
  const auto all = static_cast<double>(index.selected_points(0));
  for (int k = 1; k < index.level_count(); ++k) {
    const double wanted =
        kLevelPoints * all / static_cast<double>(std::max<std::uint64_t>(1, index.selected_points(k)));
    std::uint32_t capacity = kLeastCell;
    while (capacity < wanted && capacity < kGreatestCell) capacity *= 4;
    capacity = std::min(capacity, kGreatestCell);
    if (result.empty() || result.back().capacity != capacity) result.push_back({capacity, 0});
    result.back().levels |= 1u << k;
  }
  return result;
}

std::vector<Task> disturbed_cells(const WorkingIndex& index, const std::vector<Tiling>& tilings,
                                  const Disturbed& disturbed) {
  std::vector<Task> tasks;
  for (const Tiling& tiling : tilings) {
    for (const CurveRange& cell : index.tiles(tiling.capacity)) {
      const Task task = disturbed.in(index, cell, tiling.levels);
      if (task.levels != 0) tasks.push_back(task);
    }
  }
  return tasks;
}

struct Raise {
  std::uint64_t code;
  int from, to;
  Task by;  ///< whose bounds know of it
};

/// A raised vertex changes the surface within its star, for every level it newly belongs to.
void mark_star(const WorkingIndex& index, const std::vector<std::int32_t>& tolerances, const Raise& raise,
               Disturbed& disturbed) {
  const Position p = position_of(raise.code);
  std::vector<std::uint32_t> leaves;
  for (int k = raise.from + 1; k <= raise.to; ++k) {
    leaves.clear();
    const RegionMesh about = triangulate_region(index, levels_from(k, tolerances), {p.x, p.y, p.x, p.y});
    index.leaves_at(box_of(about.vertices, &SelectedVertex::point), leaves);
    for (const std::uint32_t leaf : leaves) {
      const bool known = (raise.by.levels >> k & 1) && raise.by.covers(index.ranges()[leaf].cell);
      if (!known) disturbed.mark(leaf, 1u << k);
    }
  }
}

/// Writes a cell's raised levels to the index, and notes what is new.
void apply(const Levels& raised, const Task& task, WorkingIndex& index, std::vector<Raise>& raises) {
  if (raised.empty()) return;
  std::vector<RawPoint> points = index.read(task.cell);
  for (RawPoint& p : points) {
    const auto found = raised.find(p.code);
    if (found == raised.end() || found->second <= p.level) continue;
    raises.push_back({p.code, p.level, found->second, task});
    p.level = static_cast<std::uint16_t>(found->second);
  }
  index.write(task.cell, points);
}

void mark_failures(const LeafBounds& bounds, const std::vector<std::int32_t>& tolerances, std::size_t leaves,
                   Disturbed& disturbed) {
  for (std::uint32_t leaf = 0; leaf < leaves; ++leaf) {
    for (std::size_t k = 1; k < tolerances.size(); ++k) {
      if (bounds.at(leaf, static_cast<int>(k)).size() > tolerances[k]) disturbed.mark(leaf, 1u << k);
    }
  }
}

std::vector<FailedPlace> failures(const LeafBounds& bounds, const std::vector<std::int32_t>& tolerances,
                                  const WorkingIndex& index) {
  std::vector<FailedPlace> places;
  for (std::uint32_t leaf = 0; leaf < index.ranges().size(); ++leaf) {
    for (std::size_t k = 1; k < tolerances.size(); ++k) {
      if (bounds.at(leaf, static_cast<int>(k)).size() > tolerances[k])
        places.push_back({square_of(index.ranges()[leaf].cell), static_cast<int>(k)});
    }
  }
  return places;
}

/// The share of the first round, which looks at everything.
constexpr double kFirstRound = 0.6;

/// Mends what more vertices can mend.
LeafBounds mend(WorkingIndex& index, const std::vector<std::int32_t>& tolerances, Progress& progress) {
  const int levels = static_cast<int>(tolerances.size());
  LeafBounds bounds(index.ranges().size(), levels);
  CallProgress call(progress);
  Disturbed disturbed(index.ranges().size());
  for (std::uint32_t leaf = 0; leaf < index.ranges().size(); ++leaf) disturbed.mark(leaf, (1u << levels) - 2);

  for (int round = 0;; ++round) {
    const std::vector<Task> tasks =
        disturbed_cells(index, round == 0 ? std::vector<Tiling>{{kFirstCell, ~0u}} : tilings(index), disturbed);
    if (tasks.empty()) return bounds;
    disturbed.clear();
    call.step(round == 0 ? kFirstRound : 0.5);

    std::vector<CellOutcome> outcomes(tasks.size());
    std::atomic<std::size_t> done = 0;
    parallel_for(tasks.size(), [&](std::size_t i) {
      progress.throw_if_cancelled();
      outcomes[i] = CellVerification(index, tolerances, tasks[i]).run(round > 0, bounds);
      const double share = static_cast<double>(++done) / static_cast<double>(tasks.size());
      call.report(round == 0 ? "verifying the levels" : "mending the levels", share);
    });

    std::vector<Raise> raises;
    for (std::size_t i = 0; i < tasks.size(); ++i) apply(outcomes[i].raised, tasks[i], index, raises);
    parallel_for(raises.size(), [&](std::size_t i) { mark_star(index, tolerances, raises[i], disturbed); });
    for (const CellOutcome& outcome : outcomes) {
      for (const auto& [code, level] : outcome.left_to_others) disturbed.mark(index.leaf_of(code), 1u << level);
    }
    if (round == 0) mark_failures(bounds, tolerances, index.ranges().size(), disturbed);
  }
}

}  // namespace

LeafBounds certify(WorkingIndex& index, const std::vector<std::int32_t>& tolerances, const RestoreLines& restore,
                   Progress& progress) {
  while (true) {
    LeafBounds bounds = mend(index, tolerances, progress);
    const std::vector<FailedPlace> failed = failures(bounds, tolerances, index);
    if (failed.empty()) return bounds;
    // No store is written that promises what does not hold.
    if (!restore(failed))
      throw Error("a level could not be brought within its tolerance; nothing was written; please report this");
  }
}

}  // namespace itin
