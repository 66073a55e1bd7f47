#include "triangulate/region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <unordered_map>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "triangulate/enclosure.hpp"
#include "triangulate/growing_mesh.hpp"
#include "triangulate/lattice_squares.hpp"
#include "triangulate/merge_runs.hpp"
#include "triangulate/mesh_order.hpp"

namespace itin {

namespace {

/// The box is this many mean point spacings wider than the region: most circumdiscs of the region's triangles fit in.
constexpr double kMargin = 4;
/// After so many rounds of mending the box may grow.
constexpr int kPatience = 32;
/// A box is not made to have more points than so many times those of the region (large regions: kLargeGrowth times and
/// kManyPoints), and a few.
constexpr std::uint64_t kGrowth = 8, kLargeGrowth = 2;
constexpr std::uint64_t kManyPoints = 1 << 16, kFewPoints = 4096;
/// Mean point spacings: cells of about 64 points.
constexpr double kCellSide = 8;
/// In points: what reading a cell costs besides. Over open water cells are empty, and no few.
constexpr std::uint64_t kCellCost = 16;

double area(const GridBox& b) {
  return b.empty() ? 0 : (1.0 + b.xmax - b.xmin) * (1.0 + b.ymax - b.ymin);
}

/// The sides of a box at which the bounds end moved far away.
GridBox with_all_beyond(GridBox box, const GridBox& bounds) {
  constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max();
  if (box.xmin <= bounds.xmin) box.xmin = -kFar;
  if (box.ymin <= bounds.ymin) box.ymin = -kFar;
  if (box.xmax >= bounds.xmax) box.xmax = kFar;
  if (box.ymax >= bounds.ymax) box.ymax = kFar;
  return box;
}

/// Closed segment against closed box, exactly.
bool meets(Position p, Position q, const GridBox& box) {
  if (box.contains(p.x, p.y) || box.contains(q.x, q.y)) return true;
  if (!box.meets({std::min(p.x, q.x), std::min(p.y, q.y), std::max(p.x, q.x), std::max(p.y, q.y)})) return false;
  bool left = false, right = false;
  for (const Position c : {Position{box.xmin, box.ymin}, Position{box.xmax, box.ymin}, Position{box.xmin, box.ymax},
                           Position{box.xmax, box.ymax}}) {
    const int side = orientation(p, q, c);
    left |= side >= 0;
    right |= side <= 0;
  }
  return left && right;
}

}  // namespace

bool circumdisc_in(Position a, Position b, Position c, const GridBox& box) {
  const double bx = static_cast<double>(b.x) - a.x, by = static_cast<double>(b.y) - a.y;
  const double cx = static_cast<double>(c.x) - a.x, cy = static_cast<double>(c.y) - a.y;
  const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy, d = 2 * (bx * cy - by * cx);
  const double ux = (cy * b2 - by * c2) / d, uy = (bx * c2 - cx * b2) / d, radius = std::sqrt(ux * ux + uy * uy);
  // The numerators lose at most 2^-50 of |b|^2 |c| + |c|^2 |b|; the area is exact to an ulp.
  const double slack = 1 + 1e-14 * (b2 * std::sqrt(c2) + c2 * std::sqrt(b2)) / std::abs(d) + 1e-14 * radius;
  const double x = a.x + ux, y = a.y + uy, reach = radius + slack;
  return x - reach >= box.xmin && x + reach <= box.xmax && y - reach >= box.ymin && y + reach <= box.ymax;
}

namespace {

class RegionTriangulation {
 public:
  RegionTriangulation(const PointIndex& index, const Selection& selection, const GridBox& tile,
                      const GridWindow* window)
      : index_(index), selection_(selection), window_(window), search_(index, selection), grown_(vertices_) {
    tile_ = intersection(tile, index.bounds());
    if (window != nullptr) tile_ = intersection(tile_, window->bounds());
    if (window != nullptr && window->holds(tile_)) window_ = nullptr;
  }

  RegionMesh run() {
    RegionMesh result;
    if (!tile_.empty() && triangulate_box(first_margin())) {
      for (int mended = 0;; ++mended) {
        do mark_ground();
        while (look_farther());
        if (!mend()) break;
        if (mended == kPatience && worth_growing()) {
          triangulate_box(4 * margin_);
          mended = 0;
        }
      }
      result = extract();
    }
    result.statistics = statistics_;
    result.statistics += search_.statistics();
    return result;
  }

 private:
  /// Reads and triangulates a box around the region, at least so large that there is a triangle. False when there is
  /// none anywhere.
  bool triangulate_box(double margin) {
    margin_ = margin;
    box_ = read_box_ = box_with(margin_);
    for (triangulate(nullptr); mesh().triangles.empty(); triangulate(nullptr)) {
      if (box_.contains(index_.bounds())) return false;
      box_ = box_with(margin_ *= 4);
      if (triangulate_seed()) return true;
      read_box_ = box_;
    }
    // A triangle needs a vertex or a segment in the box, and those tell ground from its absence.
    return true;
  }

  /// The first land beyond open water: where reading the whole box is much, one leaf of it and the lines will do to
  /// start from.
  bool triangulate_seed() {
    const std::vector<Leaf> leaves = leaves_in(box_);
    if (points_of(leaves, box_) <= kFewPoints) return false;
    const auto distance = [&](const Leaf& leaf) {
      const GridBox b = leaf.cell.box();
      return std::max({0.0, 0.0 + b.xmin - tile_.xmax, 0.0 + tile_.xmin - b.xmax, 0.0 + b.ymin - tile_.ymax,
                       0.0 + tile_.ymin - b.ymax});
    };
    triangulate(&*std::min_element(leaves.begin(), leaves.end(),
                                   [&](const Leaf& a, const Leaf& b) { return distance(a) < distance(b); }));
    return !mesh().triangles.empty();
  }

  /// Of all points in read_box_ and in the seed, if given, and of all segments in box_.
  void triangulate(const Leaf* seed) {
    hull_.clear();
    read_points(seed);
    bare_beyond_ = with_all_beyond(read_box_, index_.bounds());
    search_.pass_over(read_box_);
    known_ = KnownGround(read_box_, log2_cell_side_);
    most_known_ = most_points_;
    segments_.clear();
    const std::vector<Segment> segments = read_segments(box_);
    std::vector<Position> positions(vertices_.size());
    std::transform(vertices_.begin(), vertices_.end(), positions.begin(),
                   [](const SelectedVertex& v) { return v.position(); });
    squares_ = LatticeSquares(positions, segments, bare_beyond_);
    constraints_.clear();
    grown_.start({});
    note_segments(segments);
    triangulate_vertices();
    if (mesh().triangles.empty()) return;
    for (const Constraint& c : constraints_) grown_.lay(c.from, c.to, c.theme);
  }

  /// All but those in the midst of squares.
  void triangulate_vertices() {
    std::vector<std::uint32_t> numbers = squares_.rest();
    for (auto v = static_cast<std::uint32_t>(sorted_); v < vertices_.size(); ++v) numbers.push_back(v);
    std::vector<Position> positions(numbers.size());
    std::transform(numbers.begin(), numbers.end(), positions.begin(), [&](std::uint32_t v) { return position(v); });
    Delaunay delaunay;
    delaunay.insert(positions, numbers);
    PlaneMesh mesh = delaunay.mesh();
    squares_.fill(mesh);
    grown_.start(std::move(mesh));
  }

  GridBox box_with(double margin) const { return intersection(expanded(tile_, margin), expanded(index_.bounds(), 1)); }

  /// Where triangles reach far, as across the sea, one vertex after another turns up. A larger box has them at once.
  bool worth_growing() const {
    if (box_.contains(index_.bounds())) return false;
    return points_in(box_with(4 * margin_)) <= static_cast<double>(most_points_);
  }

  std::vector<Leaf> leaves_in(const GridBox& box) const {
    std::vector<Leaf> leaves;
    selected_leaves(index_, selection_, box, leaves);
    return leaves;
  }

  /// About how many of the leaves' points lie in a box: strips a few points wide meet many leaves.
  static double points_of(const std::vector<Leaf>& leaves, const GridBox& box) {
    return std::accumulate(leaves.begin(), leaves.end(), 0.0, [&](double sum, const Leaf& leaf) {
      return sum + leaf.points * area(intersection(leaf.cell.box(), box)) / area(leaf.cell.box());
    });
  }
  double points_in(const GridBox& box) const { return points_of(leaves_in(box), box); }

  double first_margin() {
    const double points = points_in(tile_);
    const double spacing = points > 0 ? std::sqrt(area(tile_) / points) : std::sqrt(area(tile_));
    const auto n = static_cast<std::uint64_t>(points);
    most_points_ = std::min(kGrowth * n, kLargeGrowth * n + kManyPoints) + kFewPoints;
    log2_cell_side_ = std::clamp(static_cast<int>(std::log2(spacing * kCellSide + 1)), 0, kRootLog2Side - 1);
    double margin = kMargin * spacing;
    while (margin > 1 && points_in(box_with(margin)) > static_cast<double>(most_points_)) margin /= 2;
    return margin + 1;
  }

  void read_points(const Leaf* seed) {
    std::vector<std::pair<std::uint64_t, SelectedVertex>> found;
    for (const Leaf& leaf : leaves_in(read_box_)) {
      if (leaf.level >= selection_.finest_in(intersection(leaf.cell.box(), read_box_)))
        read_block(leaf, read_box_, found);
    }
    if (seed != nullptr) read_block(*seed, box_, found);
    merge_runs(found, [](const auto& a, const auto& b) { return a.first < b.first; });
    // Themes may share a vertex, and the seed's may be read twice.
    found.erase(
        std::unique(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first == b.first; }),
        found.end());
    vertices_.clear();
    extras_.clear();
    unread_.clear();
    vertices_.reserve(found.size());
    for (const auto& [code, vertex] : found) vertices_.push_back(vertex);
    sorted_ = vertices_.size();
  }

  void read_block(const Leaf& leaf, const GridBox& box, std::vector<std::pair<std::uint64_t, SelectedVertex>>& found) {
    const auto block = index_.block(leaf);
    statistics_.points_read += block->points.size();
    statistics_.blocks_read += 1;
    for (std::size_t k = 0; k < block->points.size(); ++k) {
      const GridPoint& p = block->points[k];
      if (!box.contains(p.x, p.y)) continue;
      const std::uint8_t level = level_of(leaf, *block, k);
      if (selection_.selects(level, p.x, p.y))
        found.push_back({morton(p.x, p.y), {p, block->sources[k], level, block->theme(k)}});
    }
  }

  /// Adds the segments of a box to segments_ and returns those that are new.
  std::vector<Segment> read_segments(const GridBox& box) {
    std::vector<Segment> found, fresh;
    index_.segments(box, found);
    for (const Segment& s : found) {
      if (meets({s.ax, s.ay}, {s.bx, s.by}, box) && selection_.selects(s) && segments_.insert(s).second)
        fresh.push_back(s);
    }
    return fresh;
  }

  /// The number of the vertex at p, which is inserted if it is not there yet: as a mere position if `known` is null.
  std::uint32_t vertex_at(Position p, const SelectedVertex* known) {
    const auto first = vertices_.begin(), last = first + static_cast<std::ptrdiff_t>(sorted_);
    const std::uint64_t code = morton(p.x, p.y);
    const auto at = std::lower_bound(
        first, last, code, [](const SelectedVertex& v, std::uint64_t c) { return morton(v.point.x, v.point.y) < c; });
    if (at != last && at->position() == p) return static_cast<std::uint32_t>(at - first);
    const auto [extra, fresh] = extras_.try_emplace(code, static_cast<std::uint32_t>(vertices_.size()));
    if (fresh) {
      vertices_.push_back(known ? *known : SelectedVertex{{p.x, p.y, 0}, 0, 0, 0});
      if (!mesh().triangles.empty()) grown_.insert(extra->second);
    }
    if (known) {
      vertices_[extra->second] = *known;
      unread_.erase(extra->second);
    } else if (fresh) {
      unread_.insert(extra->second);
    }
    return extra->second;
  }

  /// Their ends become vertices.
  void note_segments(const std::vector<Segment>& segments) {
    for (const Segment& s : segments)
      constraints_.push_back({vertex_at({s.ax, s.ay}, nullptr), vertex_at({s.bx, s.by}, nullptr), s.theme});
  }

  void insert_segments(const std::vector<Segment>& segments) {
    const std::size_t before = constraints_.size();
    note_segments(segments);
    for (std::size_t k = before; k < constraints_.size(); ++k)
      grown_.lay(constraints_[k].from, constraints_[k].to, constraints_[k].theme);
  }

  const PlaneMesh& mesh() const { return grown_.mesh(); }
  Position position(std::uint32_t vertex) const { return vertices_[vertex].position(); }
  Position corner(std::uint32_t triangle, int i) const { return position(mesh().triangles[triangle][i % 3]); }
  bool constrained(std::uint32_t triangle, int i) const { return mesh().constrained[triangle] >> i & 1; }
  bool on_outline(std::uint32_t triangle, int i) const {
    return mesh().constrained[triangle] >> (i + PlaneMesh::kOutline) & 1;
  }

  /// ground_[t] is right for every triangle that meets the box: no segment crosses the box unseen, so a triangle's part
  /// in the box is ground or not as a whole, and so are neighbours whose common edge meets the box unless it is
  /// part of the outline. A box that no outline meets has a vertex or a line in it, hence is ground.
  void mark_ground() {
    ground_.assign(mesh().triangles.size(), Ground::kUnknown);
    std::vector<std::uint32_t> stack;
    const auto settle = [&](std::uint32_t t, Ground ground) {
      if (t == kNoTriangle || ground_[t] != Ground::kUnknown) return;
      ground_[t] = ground;
      stack.push_back(t);
    };
    outline_ = edges_of(Lines::kOutline);
    for (const SegmentEdge& edge : outline_) {
      if (!meets(position(edge.from), position(edge.to), box_)) continue;
      settle(edge.left, Ground::kYes);
      settle(edge.right, Ground::kNo);
    }
    if (stack.empty()) std::fill(ground_.begin(), ground_.end(), Ground::kYes);
    while (!stack.empty()) {
      const std::uint32_t t = stack.back();
      stack.pop_back();
      for (int i = 0; i < 3; ++i) {
        if (!on_outline(t, i) && meets(corner(t, i + 1), corner(t, i + 2), box_))
          settle(mesh().neighbours[t][i], ground_[t]);
      }
    }
  }

  /// The edges of all segments, or of the outline only.
  enum class Lines { kAll, kOutline };
  std::vector<SegmentEdge> edges_of(Lines which) const {
    std::vector<SegmentEdge> edges;
    for (const Constraint& c : constraints_)
      if (which == Lines::kAll || c.theme == kCoverage) grown_.edges_of(c.from, c.to, c.theme, edges);
    return edges;
  }

  /// Whether triangle t meets tile and window.
  bool in_region(std::uint32_t t) const {
    const GridBox corners = box_of(t);
    if (!corners.meets(tile_)) return false;
    if (!tile_.contains(corners) && !reaches_tile(t)) return false;
    if (window_ == nullptr) return true;
    const auto& [a, b, c] = mesh().triangles[t];
    return window_->meets(vertices_[a].point, vertices_[b].point, vertices_[c].point);
  }

  GridBox box_of(std::uint32_t t) const {
    GridBox box;
    for (const std::uint32_t v : mesh().triangles[t]) box.extend(vertices_[v].point.x, vertices_[v].point.y);
    return box;
  }

  /// The separating axis theorem, the boxes known to overlap: is the whole tile right of one edge?
  bool reaches_tile(std::uint32_t t) const {
    for (int i = 0; i < 3; ++i) {
      if (!tile_reaches_left_of(corner(t, i), corner(t, i + 1), 0)) return false;
    }
    return true;
  }

  /// Whether some corner of the tile has orientation >= least relative to pq.
  bool tile_reaches_left_of(Position p, Position q, int least) const {
    // The corner farthest to the left of pq.
    const Position c{q.y > p.y ? tile_.xmin : tile_.xmax, q.x > p.x ? tile_.ymax : tile_.ymin};
    return orientation(p, q, c) >= least;
  }

  /// Reads the ground that thin triangles see past the lines beside them, beyond what is known. True when there was
  /// some.
  bool look_farther() {
    std::vector<Cell> missing;
    // The outline alone shuts in little, and triangles across the sea see far.
    const bool lines =
        std::any_of(constraints_.begin(), constraints_.end(), [](const Constraint& c) { return c.theme != kCoverage; });
    Enclosure enclosure(mesh(), vertices_, known_, index_.bounds());
    for (std::uint32_t t = 0; t < mesh().triangles.size(); ++t) {
      if (ground_[t] != Ground::kYes || grown_.settled(t)) continue;
      if (t < squares_.triangle_count() ||
          circumdisc_in(corner(t, 0), corner(t, 1), corner(t, 2), bare_beyond_) || !in_region(t) ||
          (lines && enclosure.holds(t))) {
        grown_.settle(t);
      } else if (lines) {
        enclosure.add_missing(missing);
      }
    }
    std::sort(missing.begin(), missing.end());
    missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
    bool fresh = false;
    for (const Cell& cell : missing) fresh = read_cell(cell) || fresh;
    return fresh;
  }

  /// False when all that there may be read has been.
  bool read_cell(const Cell& cell) {
    std::vector<std::pair<std::uint64_t, SelectedVertex>> found;
    if (most_known_ == 0) return false;
    for (const Leaf& leaf : leaves_in(cell.box())) read_block(leaf, cell.box(), found);
    most_known_ -= std::min<std::uint64_t>(most_known_, found.size() + kCellCost);
    for (const auto& [code, vertex] : found) vertex_at(vertex.position(), &vertex);
    insert_segments(read_segments(square_of(cell)));
    known_.add(cell);
    return true;
  }

  /// Proves every ground triangle of the region, or inserts what disproves it. True when something was inserted.
  bool mend() {
    std::vector<SelectedVertex> intruders;
    std::vector<Segment> fresh;
    for (std::uint32_t t = 0; t < mesh().triangles.size(); ++t) {
      if (ground_[t] != Ground::kYes) continue;
      if (!grown_.settled(t)) prove(t, intruders, fresh);
      look_beyond_hull(t, intruders);
    }
    for (const SegmentEdge& edge : outline_) {
      if (edge.left == kNoTriangle) look_left_of(edge.from, edge.to, intruders);
    }
    for (const SelectedVertex& v : intruders) vertex_at(v.position(), &v);
    insert_segments(fresh);
    return !intruders.empty() || !fresh.empty();
  }

  void prove(std::uint32_t t, std::vector<SelectedVertex>& intruders, std::vector<Segment>& fresh) {
    if (!box_.contains(box_of(t))) {
      const std::vector<Segment> crossing = read_segments(box_of(t));
      fresh.insert(fresh.end(), crossing.begin(), crossing.end());
      if (!crossing.empty()) return;
    }
    // What lies in a triangle takes it away, and with it all questions about what it sees.
    std::optional<SelectedVertex> found = search_.inside(corner(t, 0), corner(t, 1), corner(t, 2));
    for (int i = 0; i < 3 && !found; ++i) {
      // Beyond edge i is left of its reverse.
      if (!constrained(t, i)) found = search_.intruder(corner(t, i + 2), corner(t, i + 1), corner(t, i));
    }
    if (found) {
      intruders.push_back(*found);
    } else {
      grown_.settle(t);
    }
  }

  void look_beyond_hull(std::uint32_t t, std::vector<SelectedVertex>& intruders) {
    const auto& v = mesh().triangles[t];
    for (int i = 0; i < 3; ++i) {
      if (mesh().neighbours[t][i] == kNoTriangle && !on_outline(t, i))
        look_left_of(v[(i + 2) % 3], v[(i + 1) % 3], intruders);
    }
  }

  /// Where the region reaches beyond a hull edge, or just to it, and there is ground, the next triangle's vertex is
  /// missing, unless the edge is on the hull of the whole surface.
  void look_left_of(std::uint32_t from, std::uint32_t to, std::vector<SelectedVertex>& intruders) {
    const Position p = position(from), q = position(to);
    if (!tile_reaches_left_of(p, q, 0) || hull_.contains({from, to})) return;
    auto found = search_.apex(p, q);
    // An edge between ends of segments far away may be none of the whole surface's: then lines may hide all from it.
    if (!found) found = search_.nearest_left_of(p, q);
    if (found) {
      intruders.push_back(*found);
    } else {
      hull_.insert({from, to});
    }
  }

  RegionMesh extract() {
    RegionMesh result;
    std::vector<std::uint32_t> triangle_number(mesh().triangles.size(), kNoTriangle);
    std::vector<std::uint32_t> kept;
    for (std::uint32_t t = 0; t < mesh().triangles.size(); ++t) {
      if (ground_[t] != Ground::kYes || !in_region(t)) continue;
      triangle_number[t] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(t);
    }
    const std::vector<std::uint32_t> vertex_number = number_vertices(kept, result.vertices);
    for (const std::uint32_t t : kept) {
      Triangle triangle{}, neighbours{};
      for (int i = 0; i < 3; ++i) {
        triangle[i] = vertex_number[mesh().triangles[t][i]];
        const std::uint32_t n = mesh().neighbours[t][i];
        neighbours[i] = n == kNoTriangle ? kNoTriangle : triangle_number[n];
      }
      result.mesh.triangles.push_back(triangle);
      result.mesh.neighbours.push_back(neighbours);
      result.mesh.constrained.push_back(mesh().constrained[t]);
    }
    for (const SegmentEdge& edge : edges_of(Lines::kAll)) {
      const auto kept_side = [&](std::uint32_t t) { return t != kNoTriangle && triangle_number[t] != kNoTriangle; };
      if (edge.theme == kCoverage || (!kept_side(edge.left) && !kept_side(edge.right))) continue;
      const auto [from, to] = std::minmax({vertex_number[edge.from], vertex_number[edge.to]});
      result.lines.push_back({from, to, edge.theme});
    }
    result.mesh = in_order(result.mesh, result.vertices.size());
    return result;
  }

  /// New numbers in Morton order for the vertices of the kept triangles.
  std::vector<std::uint32_t> number_vertices(const std::vector<std::uint32_t>& kept, std::vector<SelectedVertex>& out) {
    std::vector<std::uint8_t> used(vertices_.size(), 0);
    for (const std::uint32_t t : kept) {
      for (const std::uint32_t v : mesh().triangles[t]) used[v] = 1;
    }
    const auto code = [&](std::uint32_t v) { return morton(vertices_[v].point.x, vertices_[v].point.y); };
    std::vector<std::uint32_t> order, late;
    for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
      if (used[v]) (v < sorted_ ? order : late).push_back(v);
    }
    for (const std::uint32_t v : late) read_late(v);
    const auto less = [&](std::uint32_t a, std::uint32_t b) { return code(a) < code(b); };
    std::sort(late.begin(), late.end(), less);
    const auto middle = static_cast<std::ptrdiff_t>(order.size());
    order.insert(order.end(), late.begin(), late.end());
    std::inplace_merge(order.begin(), order.begin() + middle, order.end(), less);
    std::vector<std::uint32_t> number(vertices_.size(), kNoTriangle);
    out.reserve(order.size());
    for (const std::uint32_t v : order) {
      number[v] = static_cast<std::uint32_t>(out.size());
      out.push_back(vertices_[v]);
    }
    return number;
  }

  /// A segment's end that came in as a mere position gets its height.
  void read_late(std::uint32_t v) {
    if (!unread_.contains(v)) return;
    const auto found = search_.at(position(v));
    if (!found) {
      throw Error(fmt::format(
          "an end of a constraint line at grid position {}, {} is not among the vertices; run itin check on the store",
          position(v).x, position(v).y));
    }
    vertices_[v] = *found;
  }

  enum class Ground : std::uint8_t { kUnknown, kYes, kNo };
  struct Constraint {
    std::uint32_t from, to;
    std::uint16_t theme;
  };

  const PointIndex& index_;
  const Selection& selection_;
  const GridWindow* window_;
  ApexSearch search_;
  GridBox tile_;  ///< the region's box
  double margin_ = 0;
  std::uint64_t most_points_ = 0;  ///< that a box is worth
  GridBox box_;                    ///< all selected segments in it have been read
  GridBox read_box_;               ///< within box_: all selected points in it have been read, too
  GridBox bare_beyond_;            ///< read_box_ and what lies beyond all data behind it
  KnownGround known_;              ///< read_box_ and more
  int log2_cell_side_ = 0;
  std::uint64_t most_known_ = 0;  ///< points that may still be read into known_
  std::vector<SelectedVertex> vertices_;
  std::size_t sorted_ = 0;                                   ///< the first so many vertices are in Morton order
  std::unordered_map<std::uint64_t, std::uint32_t> extras_;  ///< the others by Morton code
  std::set<std::uint32_t> unread_;                           ///< of these, those known by position only
  std::set<Segment> segments_;
  std::vector<Constraint> constraints_;
  LatticeSquares squares_;  ///< of the points read at first
  GrowingMesh grown_;       ///< settled: a triangle that needs no more proof
  std::vector<Ground> ground_;
  std::vector<SegmentEdge> outline_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> hull_;  ///< edges known to have nothing beyond
  RetrievalStatistics statistics_;
};

}  // namespace

RegionMesh triangulate_region(const PointIndex& index, const Selection& selection, const GridBox& tile,
                              const GridWindow* window) {
  return RegionTriangulation(index, selection, tile, window).run();
}

}  // namespace itin
