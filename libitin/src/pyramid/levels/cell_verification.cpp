#include "pyramid/levels/cell_verification.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <tuple>

#include <itin/box_of.hpp>
#include <itin/detail.hpp>

#include "features/plan/hot_pixel.hpp"
#include "pyramid/difference/lattice_difference.hpp"
#include "triangulate/apex/read_once.hpp"
#include "triangulate/region/region_reader.hpp"

namespace itin {

namespace {

/// The index, with some points raised.
class IndexWithRaises final : public PointIndex {
 public:
  IndexWithRaises(const PointIndex& base, const RaisedLevels& raised) : base_(base), raised_(raised) {
    for (const auto& [code, level] : raised) {
      const std::int32_t x = morton_x(code), y = morton_y(code);
      base.leaves({}, {x, y, x, y}, leaves_);
    }
    std::sort(leaves_.begin(), leaves_.end(), before);
    const auto same = [](const Leaf& a, const Leaf& b) { return a.cell == b.cell; };
    leaves_.erase(std::unique(leaves_.begin(), leaves_.end(), same), leaves_.end());
  }

  int level_count() const override { return base_.level_count(); }
  GridBox bounds() const override { return base_.bounds(); }
  void leaves(const LevelRange& asked, const GridBox& box, std::vector<Leaf>& out) const override {
    const auto first = static_cast<std::ptrdiff_t>(out.size());
    base_.leaves(asked, box, out);
    out.erase(std::remove_if(out.begin() + first, out.end(), [&](const Leaf& leaf) { return any_raised(leaf); }),
              out.end());
    // Leaves with raised points may hold points of this level only now.
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
  const RaisedLevels& raised_;
  std::vector<Leaf> leaves_;  ///< with raised points, along the curve
};

/// Verifies leaves of one cell.
class CellVerification {
 public:
  CellVerification(const WorkingIndex& index, const std::vector<std::int32_t>& tolerances, const Task& task,
                   const WholeLevels* whole)
      : index_(index), points_(index), tolerances_(tolerances), task_(task), whole_(whole) {}

  CellOutcome run(bool mend, LeafBounds& bounds) {
    if (auto posts = WholeLattice::about(points_, task_.box)) lattice_.emplace(std::move(*posts));
    for (int k = static_cast<int>(tolerances_.size()) - 1; k >= 1; --k) {
      if (!(task_.levels >> k & 1)) continue;
      for_each_leaf([&](std::uint32_t leaf) { bounds.at(leaf, k) = {}; });
      if (lattice_ || make_mesh()) verify(k, mend, bounds);
    }
    return {std::move(raised_), std::move(left_to_others_), std::move(failing_)};
  }

 private:
  void verify(int k, bool mend, LeafBounds& bounds) {
    const std::int32_t tolerance = tolerances_[static_cast<std::size_t>(k)];
    while (true) {
      const RegionMesh coarse =
          coarse_in(k, lattice_ ? lattice_->posts().bounds() : box_of(fine_.vertices, &SelectedVertex::point));
      if (lattice_ && lattice_->compare(coarse, tolerance)) {
        if (raise(k, mend, coarse, lattice_->failures())) continue;
        return record(k, *lattice_, bounds);
      }
      make_mesh();
      const Difference d = difference(fine_, *edges_, coarse, tolerance);
      if (raise(k, mend, coarse, d.failures)) continue;
      return record(k, d, bounds);
    }
  }

  /// The surface of level k, with what was raised so far.
  RegionMesh coarse_in(int k, const GridBox& box) const {
    if (whole_ != nullptr)
      if (auto known = whole_->in(k, box)) return std::move(*known);
    const IndexWithRaises raised(points_, raised_);
    return triangulate_region(raised, levels_from(k, tolerances_), box);
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

  /// If `mend`, raises the worst point of each coarse face, and a point that breaks up each coarse edge that is too far
  /// off, if these are points of the cell. Returns whether any point was raised. A line's vertex is put back with its
  /// line instead.
  bool raise(int k, bool mend, const RegionMesh& coarse, const Failures& failures) {
    bool any = false;
    forget(k);
    const auto raise_own = [&](std::uint64_t code) {
      const Position p = position_of(code);
      if (is_vertex_of_line(p)) {
        failing_.push_back({k, p, p});
      } else if (mend && !task_.cell.cell.contains(code)) {
        left_to_others_.emplace_back(code, k);
      } else if (mend) {
        raised_[code] = k;
        any = true;
      }
    };
    for (const std::uint64_t code : failures.worst_of_faces) raise_own(code);
    failures.for_each_edge([&](std::span<const FailingCrossing> crossings) {
      // No point breaks up a line.
      if (shortcut_along(k, coarse, crossings.front())) return;
      if (const auto code = first_remedy(coarse, crossings)) raise_own(*code);
    });
    if (!any) note_shortcuts(k, mend, coarse, failures);
    return any;
  }

  /// The point that breaks up a coarse edge at the place where the edge is most off, among the places where a point
  /// does.
  static std::optional<std::uint64_t> first_remedy(const RegionMesh& coarse,
                                                   std::span<const FailingCrossing> crossings) {
    for (const FailingCrossing& c : crossings) {
      // At least one vertex is not in the coarse surface yet, or both full triangles would be coarse ones as well,
      // unless lines differ.
      const auto v =
          std::find_if(c.vertices.begin(), c.vertices.end(), [&](std::uint64_t code) { return !has(coarse, code); });
      if (v != c.vertices.end()) return *v;
    }
    return std::nullopt;
  }

  static bool has(const RegionMesh& coarse, std::uint64_t code) {
    return find_by_code(coarse.vertices, code) != coarse.vertices.end();
  }

  /// Forgets what failed before points were raised.
  void forget(int k) {
    std::erase_if(left_to_others_, [&](const auto& p) { return p.second == k; });
    std::erase_if(failing_, [&](const LineHierarchy::Shortcut& s) { return s.level == k; });
  }

  void note_shortcuts(int k, bool mend, const RegionMesh& coarse, const Failures& failures) {
    failures.for_each_edge([&](std::span<const FailingCrossing> crossings) {
      if (const auto shortcut = shortcut_along(k, coarse, crossings.front())) {
        failing_.push_back(*shortcut);
      } else if (mend && !first_remedy(coarse, crossings)) {
        note_shortcuts_about(k, crossings.front());
      }
    });
  }

  /// Notes the nearest shortcuts: a vertex that a line hid is seen past its shortcut, perhaps from afar.
  void note_shortcuts_about(int k, const FailingCrossing& c) {
    GridBox place = box_of(c.vertices, [](std::uint64_t code) { return position_of(code); });
    while (true) {
      const std::vector<LineHierarchy::Shortcut> near = shortcuts_in(k, place);
      failing_.insert(failing_.end(), near.begin(), near.end());
      if (!near.empty() || place.contains(index_.bounds())) return;
      place = expanded(place, place.xmax - place.xmin + (place.ymax - place.ymin));
    }
  }

  std::optional<LineHierarchy::Shortcut> shortcut_along(int k, const RegionMesh& coarse,
                                                        const FailingCrossing& c) const {
    const Position p = coarse.vertices[c.coarse_from].position(), q = coarse.vertices[c.coarse_to].position();
    for (const LineHierarchy::Shortcut& s : shortcuts_in(k, box_of(std::array{p, q})))
      if (on_segment(s.a, s.b, p) && on_segment(s.a, s.b, q)) return s;
    return std::nullopt;
  }

  bool is_vertex_of_line(Position p) const {
    std::vector<Segment> segments;
    points_.segments({p.x, p.y, p.x, p.y}, segments);
    return std::any_of(segments.begin(), segments.end(),
                       [&](const Segment& s) { return s.theme != kCoverage && (s.a() == p || s.b() == p); });
  }

  /// The shortcuts of level k that meet the box.
  std::vector<LineHierarchy::Shortcut> shortcuts_in(int k, const GridBox& box) const {
    std::vector<LineHierarchy::Shortcut> result;
    std::vector<Segment> segments;
    points_.segments(box, segments);
    for (const Segment& s : segments) {
      const Position a = s.a(), b = s.b();
      if (s.finest > 0 && s.finest <= k && s.coarsest >= k && meets(a, b, box))
        result.push_back({k, std::min(a, b), std::max(a, b)});
    }
    return result;
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

  /// Finds the leaves that each fine triangle may meet.
  void find_leaves() {
    std::vector<std::uint32_t> leaves;
    for (std::uint32_t t = 0; t < fine_.mesh.triangles.size(); ++t) {
      leaves.clear();
      index_.leaves_at(fine_.box_of_triangle(t), leaves);
      for (const std::uint32_t leaf : leaves) {
        if (task_.covers(index_.ranges()[leaf].cell)) triangles_of_leaves_.emplace_back(t, leaf);
      }
    }
  }

  const WorkingIndex& index_;
  const ReadOnce points_;  ///< the points of the index
  const std::vector<std::int32_t>& tolerances_;
  Task task_;
  const WholeLevels* whole_;
  std::optional<LatticeDifference> lattice_;  ///< where the full surface is a lattice
  RegionMesh fine_;                           ///< where it is no lattice, and where a level fails
  std::unique_ptr<FineEdges> edges_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> triangles_of_leaves_;
  RaisedLevels raised_;
  std::vector<std::pair<std::uint64_t, int>> left_to_others_;
  std::vector<LineHierarchy::Shortcut> failing_;
};

}  // namespace

/// Selects level k and coarser.
Selection levels_from(int k, const std::vector<std::int32_t>& tolerances) {
  const std::vector<double> metres(tolerances.begin(), tolerances.end());
  return Selection(Detail::tolerance(metres[static_cast<std::size_t>(k)]), metres, Grid{});
}

CellOutcome verify_cell(const WorkingIndex& index, const std::vector<std::int32_t>& tolerances, const Task& task,
                        bool mend, const WholeLevels* whole, LeafBounds& bounds) {
  return CellVerification(index, tolerances, task, whole).run(mend, bounds);
}

}  // namespace itin
