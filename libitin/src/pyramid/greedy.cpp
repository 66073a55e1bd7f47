#include "pyramid/greedy.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <tuple>
#include <utility>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_2.h>

#include <itin/convex_hull.hpp>

#include "pyramid/vertex_walk.hpp"
#include "triangulate/cgal_traits.hpp"

namespace itin {

namespace {

constexpr std::uint32_t kNone = 0xffffffff;

// Heights are whole units, so differences are often exactly a tolerance. Verification decides points exactly and rounds
// crossings outwards; these margins make greedy insertion decide alike.
constexpr double kPointError = 1e-6;
constexpr double kCrossingError = 2e-5;

/// The points not yet inserted that lie in a face, as a linked list.
struct FacePoints {
  std::uint32_t first = kNone;
  std::uint32_t version = 0;  ///< counts the face's reincarnations, to recognise stale queue entries
};

using Triangulation = CGAL::Delaunay_triangulation_2<
    GridTraits,
    CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_2<GridTraits>,
                                         CGAL::Triangulation_face_base_with_info_2<FacePoints, GridTraits>>>;
using Face = Triangulation::Face_handle;
using Vertex = Triangulation::Vertex_handle;

/// A point to insert: the worst one of a face, or one that breaks up the worst edge between two points.
struct Insertion {
  double error;
  std::uint32_t point;
  std::uint32_t version;   ///< of the face
  Face face;               ///< null for an edge's proposal
  std::uint32_t from, to;  ///< of the edge
  bool of_edge() const { return face == Face(); }
  /// Greatest error first, then the first point in order; the rest only makes the order one.
  bool operator<(const Insertion& p) const {
    if (error != p.error) return error < p.error;
    if (point != p.point) return point > p.point;
    return std::tuple(of_edge(), from, to) > std::tuple(p.of_edge(), p.from, p.to);
  }
};

/// What is to be inserted, level by level: a level's queue holds nothing that waits for a finer one.
class Insertions {
 public:
  /// `tolerances` ascending, that of level 0 first. Begins with the coarsest level.
  explicit Insertions(std::span<const double> tolerances)
      : tolerances_(tolerances), level_(tolerances.size() - 1), waiting_(tolerances.size()) {}

  /// Whether any level asks for what is so far off.
  bool asks_for(double error) const { return tolerances_.size() > 1 && error > tolerances_[1]; }

  /// What no level asks for is forgotten.
  void push(const Insertion& insertion) {
    if (!asks_for(insertion.error)) return;
    const auto above = std::lower_bound(tolerances_.begin(), tolerances_.end(), insertion.error) - tolerances_.begin();
    const std::size_t coarsest = static_cast<std::size_t>(above) - 1;
    if (coarsest >= level_) {
      queue_.push_back(insertion);
      std::push_heap(queue_.begin(), queue_.end());
    } else {
      waiting_[coarsest].push_back(insertion);
    }
  }

  /// The worst one that is more than this level's tolerance off; nothing where none is.
  std::optional<Insertion> pop() {
    if (queue_.empty()) return std::nullopt;
    std::pop_heap(queue_.begin(), queue_.end());
    const Insertion worst = queue_.back();
    queue_.pop_back();
    return worst;
  }

  /// From now on for this level, the next finer one. Forgets what is_stale().
  template <class IsStale>
  void begin_level(std::size_t level, const IsStale& is_stale) {
    level_ = level;
    const auto waiting = std::exchange(waiting_[level], {});
    std::copy_if(waiting.begin(), waiting.end(), std::back_inserter(queue_),
                 [&](const Insertion& insertion) { return !is_stale(insertion); });
    std::make_heap(queue_.begin(), queue_.end());
  }

 private:
  std::span<const double> tolerances_;
  std::size_t level_;
  std::vector<Insertion> queue_;
  std::vector<std::vector<Insertion>> waiting_;  ///< by level
};

class GreedyInsertion {
 public:
  GreedyInsertion(const RegionMesh& fine, std::span<const Candidacy> candidacy, std::span<const double> tolerances)
      : fine_(fine),
        candidacy_(candidacy),
        walk_(fine),
        next_(fine.vertices.size(), kNone),
        vertices_(fine.vertices.size()),
        insertions_(tolerances) {}

  /// Starts from these vertices, whose hull must contain all candidates; false while they are collinear.
  bool start(const std::vector<std::uint32_t>& vertices) {
    Face hint;
    for (const std::uint32_t v : vertices) {
      if (is_inserted(v)) continue;
      vertices_[v] = triangulation_.insert(position(v), hint);
      hint = vertices_[v]->face();
    }
    if (triangulation_.dimension() < 2) return false;
    for (std::uint32_t p = 0; p < candidacy_.size(); ++p) {
      if (is_inserted(p) || candidacy_[p] == Candidacy::kNone) continue;
      hint = locate(p, hint);
      link(p, hint);
    }
    for (Face f : triangulation_.finite_face_handles()) propose_worst_point(f);
    for (const auto& edge : triangulation_.finite_edges()) {
      propose_edge(edge.first->vertex(Triangulation::ccw(edge.second)),
                   edge.first->vertex(Triangulation::cw(edge.second)));
    }
    return true;
  }

  /// Before the vertices of each level are inserted, from the coarsest to level 1.
  void begin_level(std::size_t level) {
    insertions_.begin_level(level, [&](const Insertion& insertion) { return is_stale(insertion); });
  }

  /// Inserts these vertices, if they are not yet in.
  void insert_given(const std::vector<std::uint32_t>& vertices) {
    Face hint;
    for (const std::uint32_t v : vertices) {
      if (is_inserted(v)) continue;
      hint = locate(v, hint);
      hint = insert(v, hint);
    }
  }

  /// Inserts what is worst until nothing is more than the level's tolerance off; calls on_insert(point) for each.
  template <class OnInsert>
  void refine(const OnInsert& on_insert) {
    while (const auto worst = insertions_.pop()) {
      if (is_stale(*worst)) continue;
      const bool of_edge = worst->of_edge();
      if (!is_inserted(worst->point)) {
        insert(worst->point, of_edge ? locate(worst->point, vertices_[worst->from]->face()) : worst->face);
        on_insert(worst->point);
      }
      // An edge that has outlived the insertion needs another one.
      if (of_edge && !is_stale(*worst)) propose_edge(vertices_[worst->from], vertices_[worst->to]);
    }
  }

 private:
  TraitsPoint position(std::uint32_t p) const { return {point(p).x, point(p).y, p}; }
  const GridPoint& point(std::uint32_t p) const { return fine_.vertices[p].point; }
  const GridPoint& corner(Face f, int i) const { return point(f->vertex(i)->point().vertex); }
  bool is_inserted(std::uint32_t p) const { return vertices_[p] != Vertex(); }
  /// Whether its face or edge is no more.
  bool is_stale(const Insertion& insertion) const {
    return insertion.of_edge() ? !triangulation_.is_edge(vertices_[insertion.from], vertices_[insertion.to])
                               : insertion.face->info().version != insertion.version;
  }

  void link(std::uint32_t p, Face f) {
    next_[p] = f->info().first;
    f->info().first = p;
  }

  /// A finite face that holds p; a point on the hull may be found in an infinite one, whose neighbour holds it, too.
  Face locate(std::uint32_t p, Face hint) const {
    const Face f = triangulation_.locate(position(p), hint);
    return triangulation_.is_infinite(f) ? f->neighbor(f->index(triangulation_.infinite_vertex())) : f;
  }

  /// Returns a face at p.
  Face insert(std::uint32_t p, Face start) {
    conflicts_.clear();
    boundary_.clear();
    triangulation_.get_conflicts_and_boundary(position(p), std::back_inserter(conflicts_),
                                              std::back_inserter(boundary_), start);
    homeless_.clear();
    for (Face f : conflicts_) {
      for (std::uint32_t q = f->info().first; q != kNone; q = next_[q]) {
        if (q != p) homeless_.push_back(q);
      }
      f->info().first = kNone;
    }
    const Vertex v =
        triangulation_.star_hole(position(p), boundary_.begin(), boundary_.end(), conflicts_.begin(), conflicts_.end());
    vertices_[p] = v;
    resettle(v);
    return v->face();
  }

  /// Gives every homeless point to the face of v's star that holds it, and looks at the star's faces and edges.
  void resettle(Vertex v) {
    star_.clear();
    auto face = triangulation_.incident_faces(v), end = face;
    do {
      face->info().version += 1;
      face->info().first = kNone;
      if (triangulation_.is_infinite(face)) continue;
      const int i = face->index(v);
      star_.push_back(
          {face, face->vertex(Triangulation::ccw(i))->point(), face->vertex(Triangulation::cw(i))->point()});
    } while (++face != end);
    const TraitsPoint centre = v->point();
    std::size_t at = 0;
    for (const std::uint32_t q : homeless_) {
      const TraitsPoint p = position(q);
      for (std::size_t tried = 0; tried < star_.size() && !in_wedge(star_[at], centre, p); ++tried)
        at = (at + 1) % star_.size();
      link(q, star_[at].face);
    }
    for (const StarFace& s : star_) propose_worst_point(s.face);
    auto neighbour = triangulation_.incident_vertices(v), last = neighbour;
    do {
      if (!triangulation_.is_infinite(neighbour)) propose_edge(v, neighbour);
    } while (++neighbour != last);
  }

  struct StarFace {
    Face face;
    TraitsPoint right, left;  ///< as seen from the star's centre
  };

  static bool in_wedge(const StarFace& s, const TraitsPoint& centre, const TraitsPoint& p) {
    return orientation(centre, s.right, p) >= 0 && orientation(centre, s.left, p) <= 0;
  }

  void propose_worst_point(Face f) {
    const std::uint32_t first = f->info().first;
    if (first == kNone) return;
    const GridPoint &a = corner(f, 0), &b = corner(f, 1), &c = corner(f, 2);
    const double bx = static_cast<double>(b.x) - a.x, by = static_cast<double>(b.y) - a.y,
                 bz = static_cast<double>(b.z) - a.z;
    const double cx = static_cast<double>(c.x) - a.x, cy = static_cast<double>(c.y) - a.y,
                 cz = static_cast<double>(c.z) - a.z;
    const double area = bx * cy - by * cx;
    const double sx = (bz * cy - cz * by) / area, sy = (bx * cz - cx * bz) / area;
    double worst = -1;
    std::uint32_t worst_point = kNone;
    for (std::uint32_t q = first; q != kNone; q = next_[q]) {
      const GridPoint& p = point(q);
      const double error = std::abs(static_cast<double>(p.z) - a.z - sx * (static_cast<double>(p.x) - a.x) -
                                    sy * (static_cast<double>(p.y) - a.y));
      if (error > worst || (error == worst && q < worst_point)) {
        worst = error;
        worst_point = q;
      }
    }
    insertions_.push({worst - kPointError, worst_point, f->info().version, f, kNone, kNone});
  }

  /// Proposes what would break up edge ab: at its worst crossing with a fine edge, the end of that edge nearer to it,
  /// or the other end, or a corner opposite; whichever is first a candidate not yet inserted.
  void propose_edge(Vertex from, Vertex to) {
    std::uint32_t a = from->point().vertex, b = to->point().vertex;
    if (a > b) std::swap(a, b);
    const GridPoint &pa = point(a), &pb = point(b);
    double worst = -1;
    std::uint32_t remedy = kNone;
    walk_.walk(a, b, [&](std::uint32_t p, std::uint32_t q, std::uint32_t before, std::uint32_t behind) {
      const GridPoint &pp = point(p), &pq = point(q);
      const auto ap = static_cast<double>(doubled_area(pa, pb, pp)), aq = static_cast<double>(doubled_area(pa, pb, pq));
      const auto pqa = static_cast<double>(doubled_area(pp, pq, pa)),
                 pqb = static_cast<double>(doubled_area(pp, pq, pb));
      const double fine = pp.z + ap / (ap - aq) * (static_cast<double>(pq.z) - pp.z);
      const double coarse = pa.z + pqa / (pqa - pqb) * (static_cast<double>(pb.z) - pa.z);
      const double error = std::abs(fine - coarse);
      if (error <= worst || !insertions_.asks_for(error + kCrossingError)) return;
      const bool nearer_p = std::abs(ap) <= std::abs(aq);
      const std::uint32_t found =
          first_free({nearer_p ? p : q, nearer_p ? q : p, opposite(before, p, q), opposite(behind, p, q)});
      if (found == kNone) return;
      worst = error;
      remedy = found;
    });
    if (remedy != kNone)
      insertions_.push({worst + kCrossingError, remedy, 0, Face(), from->point().vertex, to->point().vertex});
  }

  std::uint32_t opposite(std::uint32_t triangle, std::uint32_t p, std::uint32_t q) const {
    if (triangle == kNoTriangle) return kNone;
    const auto& [a, b, c] = fine_.mesh.triangles[triangle];
    return a != p && a != q ? a : b != p && b != q ? b : c;
  }

  std::uint32_t first_free(std::initializer_list<std::uint32_t> vertices) const {
    for (const std::uint32_t v : vertices) {
      if (v != kNone && !is_inserted(v) && candidacy_[v] != Candidacy::kNone) return v;
    }
    return kNone;
  }

  const RegionMesh& fine_;
  std::span<const Candidacy> candidacy_;
  VertexWalk walk_;
  std::vector<std::uint32_t> next_;
  Triangulation triangulation_;
  std::vector<Vertex> vertices_;  ///< by point; null until it is inserted
  Insertions insertions_;
  // Kept between insertions for their memory.
  std::vector<Face> conflicts_;
  std::vector<Triangulation::Edge> boundary_;
  std::vector<std::uint32_t> homeless_;
  std::vector<StarFace> star_;
};

std::vector<std::uint32_t> hull_of(const RegionMesh& fine, std::vector<std::uint32_t> candidates) {
  const auto at = [&](std::uint32_t v) { return fine.vertices[v].position(); };
  return convex_hull(
      std::move(candidates), [&](std::uint32_t a, std::uint32_t b) { return at(a) < at(b); },
      [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) { return orientation(at(a), at(b), at(c)) > 0; });
}

}  // namespace

std::vector<std::uint8_t> greedy_levels(const RegionMesh& fine, std::span<const Candidacy> candidacy,
                                        std::span<const double> tolerances) {
  const int coarsest = static_cast<int>(tolerances.size()) - 1;
  std::vector<std::uint8_t> levels(candidacy.size(), 0);
  std::vector<std::uint32_t> candidates;
  std::vector<std::vector<std::uint32_t>> given(tolerances.size());
  for (std::uint32_t v = 0; v < candidacy.size(); ++v) {
    if (candidacy[v] == Candidacy::kNone) continue;
    candidates.push_back(v);
    levels[v] = candidacy[v] == Candidacy::kCorner ? static_cast<std::uint8_t>(coarsest) : fine.vertices[v].level;
    if (levels[v] > 0) given[levels[v]].push_back(v);
  }
  std::vector<std::uint32_t> first = hull_of(fine, candidates);
  first.insert(first.end(), given[static_cast<std::size_t>(coarsest)].begin(),
               given[static_cast<std::size_t>(coarsest)].end());
  for (const std::uint32_t p : first) levels[p] = static_cast<std::uint8_t>(coarsest);
  GreedyInsertion greedy(fine, candidacy, tolerances);
  if (!greedy.start(first)) return levels;
  for (int k = coarsest; k >= 1; --k) {
    greedy.begin_level(static_cast<std::size_t>(k));
    greedy.insert_given(given[static_cast<std::size_t>(k)]);
    greedy.refine([&](std::uint32_t p) { levels[p] = static_cast<std::uint8_t>(k); });
  }
  return levels;
}

}  // namespace itin
