#include "pyramid/certify.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <tuple>
#include <unordered_map>

#include <itin/detail.hpp>
#include <itin/error.hpp>
#include <itin/parallel.hpp>

namespace itin {

namespace {

/// Points a cell of the first round, which only looks, and of the later ones, which mend where it does not hold.
constexpr std::uint32_t kFirstCell = 1 << 15;
constexpr std::uint32_t kLaterCell = 1 << 11;

using Levels = std::unordered_map<std::uint64_t, int>;  ///< by Morton code

/// The index, with some points raised.
class RaisedIndex final : public PointIndex {
 public:
  RaisedIndex(const PointIndex& base, const Levels& raised) : base_(base), raised_(raised) {
    for (const auto& [code, level] : raised) codes_.push_back(code);
    std::sort(codes_.begin(), codes_.end());
  }

  int level_count() const override { return base_.level_count(); }
  GridBox bounds() const override { return base_.bounds(); }
  void leaves(int finest, const GridBox& box, std::vector<Leaf>& out) const override {
    if (codes_.empty()) return base_.leaves(finest, box, out);
    const std::size_t before = out.size();
    base_.leaves(0, box, out);
    const auto none_raised = [&](const Leaf& leaf) { return !any_raised(leaf.cell); };
    out.erase(std::remove_if(out.begin() + static_cast<std::ptrdiff_t>(before), out.end(), none_raised), out.end());
    std::vector<Leaf> selected;
    base_.leaves(finest, box, selected);
    std::erase_if(selected, [&](const Leaf& leaf) { return any_raised(leaf.cell); });
    out.insert(out.end(), selected.begin(), selected.end());
  }
  std::shared_ptr<const Block> block(const Leaf& leaf) const override {
    auto block = base_.block(leaf);
    if (!any_raised(leaf.cell)) return block;
    auto copy = std::make_shared<Block>(*block);
    for (std::size_t i = 0; i < copy->points.size(); ++i) {
      const auto found = raised_.find(morton(copy->points[i].x, copy->points[i].y));
      if (found != raised_.end()) copy->levels[i] = std::max(copy->levels[i], static_cast<std::uint8_t>(found->second));
    }
    return copy;
  }
  void segments(const GridBox& box, std::vector<Segment>& out) const override { base_.segments(box, out); }

 private:
  bool any_raised(const Cell& cell) const {
    const auto at = std::lower_bound(codes_.begin(), codes_.end(), cell.code);
    return at != codes_.end() && *at < cell.end();
  }

  const PointIndex& base_;
  const Levels& raised_;
  std::vector<std::uint64_t> codes_;
};

/// Selects level k and coarser.
Selection levels_from(int k, const std::vector<std::int32_t>& tolerances) {
  const std::vector<double> metres(tolerances.begin(), tolerances.end());
  return Selection(Detail::tolerance(metres[static_cast<std::size_t>(k)]), metres, Grid{});
}

GridBox box_of(const RegionMesh& mesh) {
  GridBox box;
  for (const SelectedVertex& v : mesh.vertices) box.extend(v.point.x, v.point.y);
  return box;
}

struct CellOutcome {
  Levels raised;
  /// Points of other cells, with levels, that would mend what still fails here. Their cells see the same failure.
  std::vector<std::pair<std::uint64_t, int>> left_to_others;
};

/// Verifies one cell.
class CellVerification {
 public:
  CellVerification(const WorkingIndex& index, const std::vector<std::int32_t>& tolerances, const CurveRange& cell)
      : index_(index), tolerances_(tolerances), cell_(cell) {}

  /// Levels with their bit set in `levels` are verified, and the cell's points raised, if `mend`, until they hold;
  /// bounds of the cell's leaves are replaced for these levels.
  CellOutcome run(unsigned levels, bool mend, LeafBounds& bounds) {
    fine_ = triangulate_region(index_, levels_from(0, tolerances_), square_of(cell_.cell));
    if (!fine_.mesh.triangles.empty()) edges_ = std::make_unique<FineEdges>(fine_);
    find_leaves();
    for (int k = static_cast<int>(tolerances_.size()) - 1; k >= 1; --k) {
      if (!(levels >> k & 1)) continue;
      clear(k, bounds);
      if (edges_ == nullptr) continue;
      Difference d = compare(k);
      while (mend && raise(k, d)) d = compare(k);
      record(k, d, bounds);
    }
    return {std::move(raised_), std::move(left_to_others_)};
  }

 private:
  Difference compare(int k) const {
    const RaisedIndex raised(index_, raised_);
    const RegionMesh coarse = triangulate_region(raised, levels_from(k, tolerances_), box_of(fine_));
    return difference(fine_, *edges_, coarse, tolerances_[static_cast<std::size_t>(k)]);
  }

  std::uint64_t code(std::uint32_t v) const { return morton(fine_.vertices[v].point.x, fine_.vertices[v].point.y); }

  /// Raises, if it is the cell's own, the worst point of each coarse face and what breaks up each coarse edge that is
  /// more than the tolerance off. True when there was any.
  bool raise(int k, const Difference& d) {
    bool any = false;
    std::erase_if(left_to_others_, [&](const auto& p) { return p.second == k; });
    const auto raise_own = [&](std::uint32_t v) {
      if (!cell_.cell.contains(code(v))) {
        left_to_others_.emplace_back(code(v), k);
        return;
      }
      raised_[code(v)] = k;
      any = true;
    };
    for (const std::uint32_t v : worst_by_face(d, tolerances_[static_cast<std::size_t>(k)])) raise_own(v);
    for (const Difference::Crossing& c : worst_by_edge(d)) {
      if (const auto v = remedy(c, d)) raise_own(*v);
    }
    return any;
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

  static std::vector<Difference::Crossing> worst_by_edge(const Difference& d) {
    std::vector<Difference::Crossing> crossings = d.too_large;
    const auto key = [](const Difference::Crossing& c) {
      return std::tuple(c.coarse_from, c.coarse_to, -c.size, c.fine_edge);
    };
    std::sort(crossings.begin(), crossings.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
    const auto same_edge = [](const auto& a, const auto& b) {
      return a.coarse_from == b.coarse_from && a.coarse_to == b.coarse_to;
    };
    crossings.erase(std::unique(crossings.begin(), crossings.end(), same_edge), crossings.end());
    return crossings;
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
  void visit_leaves(const Visit& visit) const {
    const auto& ranges = index_.ranges();
    for (std::uint32_t leaf = index_.leaf_of(cell_.cell.code);
         leaf < ranges.size() && ranges[leaf].cell.code < cell_.cell.end(); ++leaf) {
      visit(leaf);
    }
  }

  void clear(int k, LeafBounds& bounds) const {
    visit_leaves([&](std::uint32_t leaf) { bounds.at(leaf, k) = {}; });
  }

  /// Every leaf that a fine triangle may meet takes the triangle's range.
  void record(int k, const Difference& d, LeafBounds& bounds) const {
    std::vector<DifferenceRange> of_triangle(fine_.mesh.triangles.size());
    for (std::uint32_t e = 0; e < d.along_edge.size(); ++e) {
      const FineEdges::Edge& edge = edges_->edges()[e];
      of_triangle[edge.triangle].add(d.along_edge[e]);
      if (edge.other != kNoTriangle) of_triangle[edge.other].add(d.along_edge[e]);
    }
    for (const auto& [t, leaf] : triangles_of_leaves_) bounds.at(leaf, k).add(of_triangle[t]);
  }

  /// Which of the cell's leaves each fine triangle may meet.
  void find_leaves() {
    std::vector<std::uint32_t> leaves;
    for (std::uint32_t t = 0; t < fine_.mesh.triangles.size(); ++t) {
      GridBox box;
      for (const std::uint32_t v : fine_.mesh.triangles[t])
        box.extend(fine_.vertices[v].point.x, fine_.vertices[v].point.y);
      leaves.clear();
      index_.leaves_at(box, leaves);
      for (const std::uint32_t leaf : leaves) {
        if (cell_.cell.contains(index_.ranges()[leaf].cell)) triangles_of_leaves_.emplace_back(t, leaf);
      }
    }
  }

  const WorkingIndex& index_;
  const std::vector<std::int32_t>& tolerances_;
  CurveRange cell_;
  RegionMesh fine_;
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
  unsigned in(const WorkingIndex& index, const CurveRange& cell) const {
    unsigned levels = 0;
    for (std::uint32_t leaf = index.leaf_of(cell.cell.code);
         leaf < levels_.size() && index.ranges()[leaf].cell.code < cell.cell.end(); ++leaf) {
      levels |= levels_[leaf].load(std::memory_order_relaxed);
    }
    return levels;
  }
  void clear() {
    for (auto& l : levels_) l.store(0, std::memory_order_relaxed);
  }

 private:
  std::vector<std::atomic<unsigned>> levels_;
};

struct Raise {
  std::uint64_t code;
  int from, to;
  Cell cell;  ///< the cell that raised it, whose own bounds know of it
};

/// A raised vertex changes the surface within its star, for every level it newly belongs to.
void mark_star(const WorkingIndex& index, const std::vector<std::int32_t>& tolerances, const Raise& raise,
               Disturbed& disturbed) {
  const Position p{morton_x(raise.code), morton_y(raise.code)};
  std::vector<std::uint32_t> leaves;
  for (int k = raise.from + 1; k <= raise.to; ++k) {
    leaves.clear();
    index.leaves_at(box_of(triangulate_region(index, levels_from(k, tolerances), {p.x, p.y, p.x, p.y})), leaves);
    for (const std::uint32_t leaf : leaves) {
      if (!raise.cell.contains(index.ranges()[leaf].cell)) disturbed.mark(leaf, 1u << k);
    }
  }
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

/// Mends what more vertices can mend.
LeafBounds mend(WorkingIndex& index, const std::vector<std::int32_t>& tolerances, Progress& progress) {
  const int levels = static_cast<int>(tolerances.size());
  LeafBounds bounds(index.ranges().size(), levels);
  Disturbed disturbed(index.ranges().size());
  for (std::uint32_t leaf = 0; leaf < index.ranges().size(); ++leaf) disturbed.mark(leaf, (1u << levels) - 2);

  for (int round = 0;; ++round) {
    std::vector<std::pair<CurveRange, unsigned>> cells;
    for (const CurveRange& cell : index.tiles(round == 0 ? kFirstCell : kLaterCell)) {
      if (const unsigned todo = disturbed.in(index, cell); todo != 0) cells.emplace_back(cell, todo);
    }
    if (cells.empty()) return bounds;
    disturbed.clear();

    std::vector<CellOutcome> outcomes(cells.size());
    std::atomic<std::size_t> done = 0;
    parallel_for(cells.size(), [&](std::size_t i) {
      progress.throw_if_cancelled();
      outcomes[i] = CellVerification(index, tolerances, cells[i].first).run(cells[i].second, round > 0, bounds);
      const double share = static_cast<double>(++done) / static_cast<double>(cells.size());
      progress.report(round == 0 ? "verifying the levels" : "mending the levels", share);
    });

    std::vector<Raise> raises;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Levels& raised = outcomes[i].raised;
      std::vector<RawPoint> points = raised.empty() ? std::vector<RawPoint>{} : index.read(cells[i].first);
      for (RawPoint& p : points) {
        const auto found = raised.find(p.code);
        if (found == raised.end() || found->second <= p.level) continue;
        raises.push_back({p.code, p.level, found->second, cells[i].first.cell});
        p.level = static_cast<std::uint16_t>(found->second);
      }
      if (!points.empty()) index.write(cells[i].first, points);
    }
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
