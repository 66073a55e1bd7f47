#include "pyramid/cell_verification.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <tuple>

#include <itin/box_of.hpp>
#include <itin/detail.hpp>

#include "features/hot_pixel.hpp"
#include "pyramid/lattice_difference.hpp"
#include "triangulate/read_once.hpp"
#include "triangulate/region_reader.hpp"

namespace itin {

namespace {

/// The index, with some points raised.
class RaisedIndex final : public PointIndex {
 public:
  RaisedIndex(const PointIndex& base, const RaisedLevels& raised) : base_(base), raised_(raised) {
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
  const RaisedLevels& raised_;
  std::vector<Leaf> leaves_;  ///< with raised points, along the curve
};

/// Verifies leaves of one cell.
class CellVerification {
 public:
  CellVerification(const WorkingIndex& index, const std::vector<std::int32_t>& tolerances, const Task& task)
      : index_(index), points_(index), tolerances_(tolerances), task_(task) {}

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
      const RaisedIndex raised(points_, raised_);
      const RegionMesh coarse =
          triangulate_region(raised, levels_from(k, tolerances_),
                             lattice_ ? lattice_->posts().bounds() : box_of(fine_.vertices, &SelectedVertex::point));
      // What fails is mended by triangles.
      if (lattice_ && lattice_->compare(coarse) && (!mend || lattice_->whole().size() <= tolerance)) {
        forget(k);
        return record(k, *lattice_, bounds);
      }
      make_mesh();
      const Difference d = difference(fine_, *edges_, coarse, tolerance);
      if (raise(k, mend, coarse, d)) continue;
      note_shortcuts(k, coarse, d, mend);
      return record(k, d, bounds);
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

  GridBox box_of_triangle(std::uint32_t t) const {
    return box_of(fine_.mesh.triangles[t], [&](std::uint32_t v) { return fine_.vertices[v].position(); });
  }

  /// Raises, if it is the cell's own, the worst point of each coarse face and what breaks up each coarse edge that is
  /// more than the tolerance off. True when there was any. A line's vertex is put back with its line.
  bool raise(int k, bool mend, const RegionMesh& coarse, const Difference& d) {
    bool any = false;
    forget(k);
    const auto raise_own = [&](std::uint32_t v) {
      const Position p = fine_.vertices[v].position();
      const std::uint64_t code = code_of(p);
      if (is_vertex_of_line(p)) {
        failing_.push_back({k, p, p});
      } else if (mend && !task_.cell.cell.contains(code)) {
        left_to_others_.emplace_back(code, k);
      } else if (mend) {
        raised_[code] = k;
        any = true;
      }
    };
    for (const std::uint32_t v : worst_by_face(d, tolerances_[static_cast<std::size_t>(k)])) raise_own(v);
    for (const std::uint32_t v : remedies(k, coarse, d)) raise_own(v);
    return any;
  }

  /// What failed before points were raised.
  void forget(int k) {
    std::erase_if(left_to_others_, [&](const auto& p) { return p.second == k; });
    std::erase_if(failing_, [&](const LineHierarchy::Shortcut& s) { return s.level == k; });
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

  /// The point that breaks up each coarse edge at the place where it is most off, among those where any point does. No
  /// point breaks up a line.
  std::vector<std::uint32_t> remedies(int k, const RegionMesh& coarse, const Difference& d) const {
    std::vector<std::uint32_t> result;
    for_each_too_large(d, [&](std::span<const Difference::Crossing> crossings) {
      if (shortcut_along(k, coarse, crossings.front())) return;
      for (const Difference::Crossing& c : crossings) {
        if (const auto v = remedy(c, d)) return result.push_back(*v);
      }
    });
    return result;
  }

  void note_shortcuts(int k, const RegionMesh& coarse, const Difference& d, bool mend) {
    for_each_too_large(d, [&](std::span<const Difference::Crossing> crossings) {
      if (const auto shortcut = shortcut_along(k, coarse, crossings.front())) {
        failing_.push_back(*shortcut);
      } else if (mend && std::none_of(crossings.begin(), crossings.end(),
                                      [&](const Difference::Crossing& c) { return remedy(c, d).has_value(); })) {
        note_shortcuts_about(k, crossings.front());
      }
    });
  }

  /// A vertex that a line hid is seen past its shortcut, perhaps from afar.
  void note_shortcuts_about(int k, const Difference::Crossing& c) {
    const FineEdges::Edge& edge = edges_->edges()[c.fine_edge];
    GridBox place;
    for (const std::uint32_t t : {edge.triangle, edge.other}) {
      if (t != kNoTriangle) place.extend(box_of_triangle(t));
    }
    while (true) {
      const std::vector<LineHierarchy::Shortcut> near = shortcuts_in(k, place);
      failing_.insert(failing_.end(), near.begin(), near.end());
      if (!near.empty() || place.contains(index_.bounds())) return;
      place = expanded(place, place.xmax - place.xmin + (place.ymax - place.ymin));
    }
  }

  std::optional<LineHierarchy::Shortcut> shortcut_along(int k, const RegionMesh& coarse,
                                                        const Difference::Crossing& c) const {
    const Position p = coarse.vertices[c.coarse_from].position(), q = coarse.vertices[c.coarse_to].position();
    for (const LineHierarchy::Shortcut& s : shortcuts_in(k, box_of(std::array{p, q})))
      if (on_segment(s.a, s.b, p) && on_segment(s.a, s.b, q)) return s;
    return std::nullopt;
  }

  bool is_vertex_of_line(Position p) const {
    std::vector<Segment> segments;
    points_.segments({p.x, p.y, p.x, p.y}, segments);
    return std::any_of(segments.begin(), segments.end(), [&](const Segment& s) {
      return s.theme != kCoverage && (Position{s.ax, s.ay} == p || Position{s.bx, s.by} == p);
    });
  }

  /// Those of level k that meet the box.
  std::vector<LineHierarchy::Shortcut> shortcuts_in(int k, const GridBox& box) const {
    std::vector<LineHierarchy::Shortcut> result;
    std::vector<Segment> segments;
    points_.segments(box, segments);
    for (const Segment& s : segments) {
      const Position a{s.ax, s.ay}, b{s.bx, s.by};
      if (s.finest > 0 && s.finest <= k && s.coarsest >= k && meets(a, b, box))
        result.push_back({k, std::min(a, b), std::max(a, b)});
    }
    return result;
  }

  /// Calls visit with the crossings that are too large along each coarse edge, the worst one first. Ties go to the
  /// first place by its ends' codes: cells that leave points to each other agree on them, or none would ever raise any.
  template <class Visit>
  void for_each_too_large(const Difference& d, const Visit& visit) const {
    std::vector<Difference::Crossing> crossings = d.too_large;
    const auto coarse_edge = [](const Difference::Crossing& c) { return std::pair(c.coarse_from, c.coarse_to); };
    const auto key = [&](const Difference::Crossing& c) {
      const FineEdges::Edge& edge = edges_->edges()[c.fine_edge];
      return std::tuple(coarse_edge(c), -c.size, std::min(edge.u, edge.v), std::max(edge.u, edge.v));
    };
    std::sort(crossings.begin(), crossings.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
    for (auto first = crossings.begin(); first != crossings.end();) {
      const auto last =
          std::find_if(first, crossings.end(), [&](const auto& c) { return coarse_edge(c) != coarse_edge(*first); });
      visit(std::span(first, last));
      first = last;
    }
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
      leaves.clear();
      index_.leaves_at(box_of_triangle(t), leaves);
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
                        bool mend, LeafBounds& bounds) {
  return CellVerification(index, tolerances, task).run(mend, bounds);
}

}  // namespace itin
