#include "triangulate/region/region.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>

#include <itin/box_of.hpp>
#include <itin/error.hpp>
#include <itin/sort_unique.hpp>

#include "base/stoppable.hpp"
#include "geometry/box_gap.hpp"
#include "triangulate/mesh/circumdisc.hpp"
#include "triangulate/mesh/growing_mesh.hpp"
#include "triangulate/mesh/triangle_box.hpp"
#include "triangulate/region/cut_out.hpp"
#include "triangulate/region/enclosure.hpp"
#include "triangulate/region/lattice_squares.hpp"
#include "triangulate/region/region_reader.hpp"
#include "triangulate/region/right_triangles.hpp"

namespace itin {

namespace {

/// The margin of the box about the region, in mean point spacings: most circumdiscs of the region's triangles fit in
/// it.
constexpr double kMargin = 4;
/// The rounds of mending after which the box may grow.
constexpr int kPatience = 32;
/// Limits to a box's points: kGrowth times the region's points (for large regions kLargeGrowth times, and kManyPoints),
/// and kFewPoints more.
constexpr std::uint64_t kGrowth = 8, kLargeGrowth = 2;
constexpr std::uint64_t kManyPoints = 1 << 16, kFewPoints = 4096;
/// About as many of the nearest points surround open water.
constexpr std::uint64_t kSeedPoints = 256;
/// The side of cells in mean point spacings: cells have about 64 points.
constexpr double kCellSide = 8;
/// The cost of reading a cell, expressed in points. Over open water there are many cells, all empty.
constexpr std::uint64_t kCellCost = 16;

class RegionTriangulation {
 public:
  RegionTriangulation(const PointIndex& index, const Selection& selection, const GridBox& tile,
                      const GridWindow* window)
      : index_(index),
        window_(window),
        finest_(selection.finest()),
        read_(index, selection),
        search_(index, selection),
        grown_(read_.vertices()) {
    tile_ = intersection(tile, index.bounds());
    if (window != nullptr) tile_ = intersection(tile_, window->bounds());
    if (window != nullptr && window->holds(tile_)) window_ = nullptr;
  }

  RegionMesh run() {
    RegionMesh result;
    if (!tile_.empty() && triangulate_box(first_margin())) {
      // Every round puts a vertex or a segment of the store into the mesh, or the box grows: the loop ends, whatever is
      // stored.
      for (int rounds = 0;; ++rounds) {
        stop_if_asked();
        do mark_ground();
        while (extend());
        const Mending mending = mend();
        if (mending == Mending::kDone) break;
        if (mending == Mending::kInVain) require_more_ground();
        if (mending == Mending::kInVain || (rounds == kPatience && worth_growing())) {
          triangulate_box(4 * margin_);
          rounds = 0;
        }
      }
      result = extract();
    }
    result.statistics = read_.statistics();
    result.statistics += search_.statistics();
    return result;
  }

 private:
  /// Reads and triangulates a box around the region, large enough that there is a triangle. Returns false when there is
  /// no triangle anywhere.
  bool triangulate_box(double margin) {
    margin_ = margin;
    box_ = read_box_ = box_with(margin_);
    for (triangulate({}); mesh().triangles.empty(); triangulate({})) {
      if (box_.contains(index_.bounds())) return false;
      box_ = box_with(margin_ *= 4);
      if (triangulate_seed()) return true;
      read_box_ = box_;
    }
    // A triangle needs a vertex or a segment in the box, and these tell where there is ground.
    return true;
  }

  /// Triangulates the nearest land beyond open water. Where reading the whole box takes long, a few leaves of it and
  /// the lines are enough to start from. Returns false where this does not apply.
  bool triangulate_seed() {
    const std::vector<Leaf> leaves = read_.leaves_in(box_);
    if (RegionReader::points_of(leaves, box_) <= kFewPoints) return false;
    std::vector<std::pair<double, std::size_t>> nearest_first;
    for (std::size_t i = 0; i < leaves.size(); ++i)
      nearest_first.emplace_back(squared_gap(tile_, leaves[i].cell.box()), i);
    std::sort(nearest_first.begin(), nearest_first.end());
    std::vector<Leaf> seed;
    std::uint64_t points = 0;
    for (auto next = nearest_first.begin(); next != nearest_first.end() && points < kSeedPoints; ++next) {
      seed.push_back(leaves[next->second]);
      points += seed.back().points;
    }
    triangulate(seed);
    return !mesh().triangles.empty();
  }

  /// Triangulates all points in read_box_ and in the seed, with all segments in box_.
  void triangulate(std::span<const Leaf> seed) {
    hull_.clear();
    read_.start(read_box_, seed, box_);
    bare_beyond_ = with_all_beyond(read_box_, index_.bounds());
    search_.pass_over(read_box_);
    known_ = KnownGround(read_box_, log2_cell_side_);
    most_known_ = most_points_;
    const std::vector<Segment> segments = read_.fresh_segments(box_);
    std::vector<Position> positions(read_.vertices().size());
    std::transform(read_.vertices().begin(), read_.vertices().end(), positions.begin(),
                   [](const SelectedVertex& v) { return v.position(); });
    known_triangles_ = find_known_triangles(positions, segments);
    constraints_.clear();
    outline_changed_ = true;
    grown_.start({});
    insert(segments);
    triangulate_vertices();
    if (mesh().triangles.empty()) return;
    for (const Constraint& c : constraints_) grown_.lay(c.from, c.to, c.theme);
  }

  /// Finds the triangles that need no triangulation. Fine levels of rasters are right triangles on posts; where nearly
  /// all posts are there, their squares tell as much sooner.
  std::unique_ptr<KnownTriangles> find_known_triangles(std::span<const Position> positions,
                                                       std::span<const Segment> segments) const {
    if (finest_ > 0) {
      auto triangles = std::make_unique<RightTriangles>(positions, segments, bare_beyond_);
      if (triangles->triangle_count() > 0) return triangles;
    }
    return std::make_unique<LatticeSquares>(positions, segments, bare_beyond_);
  }

  /// Triangulates all vertices except those that have known triangles only.
  void triangulate_vertices() {
    std::vector<std::uint32_t> numbers = known_triangles_->rest();
    for (std::uint32_t v = read_.in_order(); v < read_.vertices().size(); ++v) numbers.push_back(v);
    std::vector<Position> positions(numbers.size());
    std::transform(numbers.begin(), numbers.end(), positions.begin(), [&](std::uint32_t v) { return position(v); });
    Delaunay delaunay;
    delaunay.insert(positions, numbers);
    PlaneMesh mesh = delaunay.mesh();
    known_triangles_->fill(mesh);
    grown_.start(std::move(mesh));
  }

  GridBox box_with(double margin) const { return intersection(expanded(tile_, margin), expanded(index_.bounds(), 1)); }

  /// Tells whether a larger box pays. Where triangles reach far, as across the sea, one vertex after another turns up;
  /// a larger box has them at once.
  bool worth_growing() const {
    if (box_.contains(index_.bounds())) return false;
    return read_.points_in(box_with(4 * margin_)) <= static_cast<double>(most_points_);
  }

  double first_margin() {
    const double points = read_.points_in(tile_);
    const double spacing = points > 0 ? std::sqrt(area(tile_) / points) : std::sqrt(area(tile_));
    const auto n = static_cast<std::uint64_t>(points);
    most_points_ = std::min(kGrowth * n, kLargeGrowth * n + kManyPoints) + kFewPoints;
    log2_cell_side_ = std::clamp(static_cast<int>(std::log2(spacing * kCellSide + 1)), 0, kRootLog2Side - 1);
    double margin = kMargin * spacing;
    while (margin > 1 && read_.points_in(box_with(margin)) > static_cast<double>(most_points_)) margin /= 2;
    return margin + 1;
  }

  /// Throws where all ground has been read. A sound store never needs more: the vertices and lines of such a store
  /// contradict each other.
  void require_more_ground() const {
    if (box_.contains(index_.bounds()))
      throw Error(
          fmt::format("vertices and lines between grid positions {}, {} and {}, {} contradict each other; run "
                      "itin check on the store",
                      tile_.xmin, tile_.ymin, tile_.xmax, tile_.ymax));
  }

  /// Inserts a vertex; returns whether it is new.
  bool insert(const SelectedVertex& vertex) {
    const auto [number, fresh] = read_.number_of(vertex);
    if (fresh) grown_.insert(number);
    return fresh;
  }

  /// Returns the number of a segment's end, which goes into the mesh if there is one.
  std::uint32_t end_at(Position p) {
    const auto [number, fresh] = read_.number_of(p);
    if (fresh && !mesh().triangles.empty()) grown_.insert(number);
    return number;
  }

  /// Inserts segments, into the mesh if there is one. Their ends become vertices.
  void insert(const std::vector<Segment>& segments) {
    for (const Segment& s : segments) {
      const Constraint c{end_at(s.a()), end_at(s.b()), s.theme};
      constraints_.push_back(c);
      outline_changed_ = outline_changed_ || c.theme == kCoverage;
      if (!mesh().triangles.empty()) grown_.lay(c.from, c.to, c.theme);
    }
  }

  const PlaneMesh& mesh() const { return grown_.mesh(); }
  Position position(std::uint32_t vertex) const { return read_.vertices()[vertex].position(); }
  Position corner(std::uint32_t triangle, int i) const { return position(mesh().triangles[triangle][i % 3]); }
  bool constrained(std::uint32_t triangle, int i) const { return mesh().constrained[triangle] >> i & 1; }
  bool on_outline(std::uint32_t triangle, int i) const {
    return mesh().constrained[triangle] >> (i + PlaneMesh::kOutline) & 1;
  }

  enum class Ground : std::uint8_t { kUnknown, kYes, kNo };
  /// Marks the triangles of the ground: ground_[t] is right for every triangle that meets the box. All segments that
  /// cross the box are known, so a triangle's part in the box is ground or not as a whole. So are neighbours whose
  /// common edge meets the box, unless the edge is part of the outline. A box that no outline meets has a vertex or a
  /// line in it, hence is ground.
  void mark_ground() {
    const std::vector<std::uint32_t> changed = grown_.take_changed();
    ground_.resize(mesh().triangles.size(), Ground::kUnknown);
    if (outline_changed_ || !mark_changed(changed)) mark_all();
  }

  void mark_all() {
    outline_changed_ = false;
    outline_ = edges_of(Lines::kOutline);
    ground_.assign(mesh().triangles.size(), Ground::kUnknown);
    open_.resize(mesh().triangles.size());
    std::iota(open_.begin(), open_.end(), 0u);
    std::vector<std::uint32_t> marked;
    for (const SegmentEdge& edge : outline_) {
      if (!meets(position(edge.from), position(edge.to), box_)) continue;
      mark(edge.left, Ground::kYes, marked);
      mark(edge.right, Ground::kNo, marked);
    }
    all_ground_ = marked.empty();
    if (all_ground_) std::fill(ground_.begin(), ground_.end(), Ground::kYes);
    spread(marked);
  }

  /// Marks these triangles, which have changed since all were marked, by their unchanged neighbours. Returns false
  /// where that is not enough: all must be marked then.
  bool mark_changed(const std::vector<std::uint32_t>& changed) {
    for (const std::uint32_t t : changed) ground_[t] = Ground::kUnknown;
    std::vector<std::uint32_t> marked;
    bool at_outline = false;
    for (const std::uint32_t t : changed) {
      if (all_ground_) mark(t, Ground::kYes, marked);
      for (int i = 0; i < 3; ++i) {
        at_outline = at_outline || on_outline(t, i);
        const std::uint32_t n = mesh().neighbours[t][i];
        if (n != kNoTriangle && ground_[n] != Ground::kUnknown && same_side(t, i)) mark(t, ground_[n], marked);
      }
    }
    spread(marked);
    const auto unknown = [&](std::uint32_t t) {
      return ground_[t] == Ground::kUnknown && box_of_triangle(t).meets(box_);
    };
    if (std::any_of(changed.begin(), changed.end(), unknown)) return false;
    if (at_outline) outline_ = edges_of(Lines::kOutline);
    open_.insert(open_.end(), marked.begin(), marked.end());
    sort_unique(open_);
    return true;
  }

  void mark(std::uint32_t t, Ground ground, std::vector<std::uint32_t>& marked) {
    if (t == kNoTriangle || ground_[t] != Ground::kUnknown) return;
    ground_[t] = ground;
    marked.push_back(t);
  }

  /// Marks the neighbours of marked triangles like these, and so on. Appends the triangles that it marks.
  void spread(std::vector<std::uint32_t>& marked) {
    for (std::size_t next = 0; next < marked.size(); ++next) {
      const std::uint32_t t = marked[next];
      for (int i = 0; i < 3; ++i)
        if (same_side(t, i)) mark(mesh().neighbours[t][i], ground_[t], marked);
    }
  }

  /// Tells whether the place beyond edge i is ground if the triangle is, and no ground if it is not.
  bool same_side(std::uint32_t t, int i) const {
    return !on_outline(t, i) && meets(corner(t, i + 1), corner(t, i + 2), box_);
  }

  /// Edges of all segments, or of the outline only.
  enum class Lines { kAll, kOutline };
  std::vector<SegmentEdge> edges_of(Lines which) const {
    std::vector<SegmentEdge> edges;
    for (const Constraint& c : constraints_)
      if (which == Lines::kAll || c.theme == kCoverage) grown_.edges_of(c.from, c.to, c.theme, edges);
    return edges;
  }

  /// Tells whether triangle t meets tile and window.
  bool in_region(std::uint32_t t) const {
    if (!triangle_meets({corner(t, 0), corner(t, 1), corner(t, 2)}, tile_)) return false;
    if (window_ == nullptr) return true;
    const auto at = [&](int i) { return read_.vertices()[mesh().triangles[t][i]].point; };
    return window_->meets(at(0), at(1), at(2));
  }

  GridBox box_of_triangle(std::uint32_t t) const {
    return box_of(mesh().triangles[t], [&](std::uint32_t v) { return position(v); });
  }

  /// Reads the unknown ground that thin triangles see past the lines beside them. Returns whether there was some.
  bool extend() {
    std::vector<Cell> missing;
    // Without lines this does not pay: the outline alone shuts in little, and triangles across the sea see far.
    const bool lines =
        std::any_of(constraints_.begin(), constraints_.end(), [](const Constraint& c) { return c.theme != kCoverage; });
    Enclosure enclosure(mesh(), read_.vertices(), known_, index_.bounds());
    for (const std::uint32_t t : open_) {
      if (ground_[t] != Ground::kYes || grown_.is_proved(t)) continue;
      if (t < known_triangles_->triangle_count() ||
          circumdisc_in(corner(t, 0), corner(t, 1), corner(t, 2), bare_beyond_) || !in_region(t) ||
          (lines && enclosure.holds(t))) {
        grown_.mark_proved(t);
      } else if (lines) {
        enclosure.add_missing(missing);
      }
    }
    sort_unique(missing);
    bool fresh = false;
    for (const Cell& cell : missing) fresh = read_cell(cell) || fresh;
    return fresh;
  }

  /// Reads a cell. Returns false when no more points may be read.
  bool read_cell(const Cell& cell) {
    if (most_known_ == 0) return false;
    const std::vector<RegionReader::Coded> found = read_.points(cell.box());
    most_known_ -= std::min<std::uint64_t>(most_known_, found.size() + kCellCost);
    for (const auto& [code, vertex] : found) insert(vertex);
    insert(read_.fresh_segments(square_of(cell)));
    known_.add(cell);
    return true;
  }

  enum class Mending : std::uint8_t { kDone, kGoesOn, kInVain };
  /// Proves every ground triangle of the region, or inserts the items that disprove it; in vain where the mesh has all
  /// of these.
  Mending mend() {
    std::vector<SelectedVertex> intruders;
    std::vector<Segment> fresh;
    std::vector<std::uint32_t> still_open;
    for (const std::uint32_t t : open_) {
      if (ground_[t] != Ground::kYes) continue;
      if (!grown_.is_proved(t)) prove(t, intruders, fresh);
      if (seek_beyond_hull(t, intruders) || !grown_.is_proved(t)) still_open.push_back(t);
    }
    open_ = std::move(still_open);
    for (const SegmentEdge& edge : outline_) {
      if (edge.left == kNoTriangle) seek_left_of(edge.from, edge.to, intruders);
    }
    if (intruders.empty() && fresh.empty()) return Mending::kDone;
    bool inserted = !fresh.empty();
    for (const SelectedVertex& v : intruders) inserted = insert(v) || inserted;
    insert(fresh);
    return inserted ? Mending::kGoesOn : Mending::kInVain;
  }

  void prove(std::uint32_t t, std::vector<SelectedVertex>& intruders, std::vector<Segment>& fresh) {
    stop_if_asked();
    // A missing vertex is missing for many triangles. Triangles that are still left then are asked about the next time.
    if (std::any_of(intruders.begin(), intruders.end(), [&](const SelectedVertex& v) { return disturbs(v, t); }))
      return;
    if (!box_.contains(box_of_triangle(t))) {
      const std::vector<Segment> crossing = read_.fresh_segments(box_of_triangle(t));
      fresh.insert(fresh.end(), crossing.begin(), crossing.end());
      if (!crossing.empty()) return;
    }
    // A vertex within a triangle removes the triangle, and with it all questions about what it sees. The one nearest to
    // the region removes most of the open water about it.
    std::optional<SelectedVertex> found = search_.inside(corner(t, 0), corner(t, 1), corner(t, 2), tile_);
    for (int i = 0; i < 3 && !found; ++i) {
      // The place beyond edge i is left of the reversed edge.
      if (!constrained(t, i)) found = search_.intruder(corner(t, i + 2), corner(t, i + 1), corner(t, i));
    }
    if (found) {
      intruders.push_back(*found);
    } else {
      grown_.mark_proved(t);
    }
  }

  /// Tells whether a vertex lies in the circumcircle of t.
  bool disturbs(const SelectedVertex& v, std::uint32_t t) const {
    return in_circle_perturbed(corner(t, 0), corner(t, 1), corner(t, 2), v.position()) > 0;
  }

  /// Seeks vertices beyond the hull edges of t; returns whether it found any.
  bool seek_beyond_hull(std::uint32_t t, std::vector<SelectedVertex>& intruders) {
    const std::size_t before = intruders.size();
    const auto& v = mesh().triangles[t];
    for (int i = 0; i < 3; ++i) {
      if (mesh().neighbours[t][i] == kNoTriangle && !on_outline(t, i))
        seek_left_of(v[(i + 2) % 3], v[(i + 1) % 3], intruders);
    }
    return intruders.size() > before;
  }

  /// Seeks the vertex of the next triangle, which is missing where the region reaches a hull edge or beyond and there
  /// is ground there, unless the edge is on the hull of the whole surface.
  void seek_left_of(std::uint32_t from, std::uint32_t to, std::vector<SelectedVertex>& intruders) {
    const Position p = position(from), q = position(to);
    if (!reaches_left_of(tile_, p, q) || hull_.contains({from, to})) return;
    auto found = search_.apex(p, q);
    // An edge between ends of distant segments may not be an edge of the whole surface: then lines may hide everything
    // from it.
    if (!found) found = search_.nearest_left_of(p, q);
    if (found) {
      intruders.push_back(*found);
    } else {
      hull_.insert({from, to});
    }
  }

  RegionMesh extract() {
    std::vector<std::uint32_t> kept;
    for (std::uint32_t t = 0; t < mesh().triangles.size(); ++t) {
      if (ground_[t] != Ground::kYes || !in_region(t)) continue;
      kept.push_back(t);
      for (const std::uint32_t v : mesh().triangles[t]) read_.complete(v, search_);
    }
    return cut_out(mesh(), kept, edges_of(Lines::kAll), read_.vertices(), read_.in_order());
  }

  struct Constraint {
    std::uint32_t from, to;
    std::uint16_t theme;
  };

  const PointIndex& index_;
  const GridWindow* window_;
  const int finest_;  ///< the finest level that is asked for anywhere
  RegionReader read_;
  ApexSearch search_;
  GridBox tile_;  ///< the region's box
  double margin_ = 0;
  std::uint64_t most_points_ = 0;  ///< the most points that are worth reading into a box
  GridBox box_;                    ///< a box all of whose selected segments have been read
  GridBox read_box_;               ///< a box within box_ all of whose selected points have been read, too
  GridBox bare_beyond_;            ///< read_box_, extended without end on the sides where the data end
  KnownGround known_;              ///< read_box_ and more
  int log2_cell_side_ = 0;
  std::uint64_t most_known_ = 0;  ///< points that may still be read into known_
  std::vector<Constraint> constraints_;
  std::unique_ptr<KnownTriangles> known_triangles_;  ///< those of the points read at first
  GrowingMesh grown_;                                ///< its proved triangles need no more proof
  std::vector<Ground> ground_;
  std::vector<SegmentEdge> outline_;
  bool outline_changed_ = true;  ///< the outline has changed since all triangles were marked
  bool all_ground_ = false;      ///< no outline meets the box
  /// Triangles of the ground that need proof, or have a vertex beyond an edge of the hull; and some more. Ascending.
  std::vector<std::uint32_t> open_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> hull_;  ///< edges known to have no vertex beyond
};

}  // namespace

RegionMesh triangulate_region(const PointIndex& index, const Selection& selection, const GridBox& tile,
                              const GridWindow* window) {
  return RegionTriangulation(index, selection, tile, window).run();
}

}  // namespace itin
