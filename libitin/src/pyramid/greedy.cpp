#include "pyramid/greedy.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_2.h>

#include "triangulate/cgal_traits.hpp"

namespace itin {

namespace {

constexpr std::uint32_t kNone = 0xffffffff;

/// The points not yet inserted that lie in a face, as a linked list, and the worst of them.
struct FacePoints {
  std::uint32_t first = kNone;
  std::uint32_t worst = kNone;
  std::uint32_t version = 0;  ///< counts the face's reincarnations, to recognise stale queue entries
};

using Triangulation = CGAL::Delaunay_triangulation_2<
    GridTraits, CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_2<GridTraits>,
                                                     CGAL::Triangulation_face_base_with_info_2<FacePoints, GridTraits>>>;
using Face = Triangulation::Face_handle;
using Vertex = Triangulation::Vertex_handle;

struct Candidate {
  double error;
  std::uint32_t point;
  std::uint32_t version;
  Face face;
  /// Greatest error first, then the first point in order.
  bool operator<(const Candidate& c) const { return error != c.error ? error < c.error : point > c.point; }
};

class GreedyInsertion {
 public:
  explicit GreedyInsertion(std::span<const GridPoint> points)
      : points_(points), next_(points.size(), kNone), inserted_(points.size(), 0) {}

  bool inserted(std::uint32_t point) const { return inserted_[point]; }

  /// Starts from these vertices, whose hull must contain all points; false while they are collinear.
  bool start(const std::vector<std::uint32_t>& vertices) {
    Face hint;
    for (const std::uint32_t v : vertices) {
      if (inserted_[v]) continue;
      inserted_[v] = 1;
      hint = triangulation_.insert(position(v), hint)->face();
    }
    if (triangulation_.dimension() < 2) return false;
    for (std::uint32_t p = 0; p < points_.size(); ++p) {
      if (inserted_[p]) continue;
      hint = triangulation_.locate(position(p), hint);
      if (triangulation_.is_infinite(hint)) hint = finite_face_on_hull(hint);
      link(p, hint);
    }
    for (Face f : triangulation_.finite_face_handles()) enqueue(f);
    return true;
  }

  /// Inserts worst points until none is more than `tolerance` off; calls on_insert(point) for each.
  template <class OnInsert>
  void refine(double tolerance, const OnInsert& on_insert) {
    while (!queue_.empty() && queue_.top().error > tolerance) {
      const Candidate top = queue_.top();
      queue_.pop();
      if (top.face->info().version != top.version) continue;
      insert(top.point, top.face);
      on_insert(top.point);
    }
  }

 private:
  TraitsPoint position(std::uint32_t p) const { return {points_[p].x, points_[p].y, p}; }
  const GridPoint& corner(Face f, int i) const { return points_[f->vertex(i)->point().vertex]; }

  void link(std::uint32_t p, Face f) {
    next_[p] = f->info().first;
    f->info().first = p;
  }

  /// A point on the hull is located in an infinite face now and then; its neighbour holds it.
  Face finite_face_on_hull(Face f) const { return f->neighbor(f->index(triangulation_.infinite_vertex())); }

  void insert(std::uint32_t p, Face start) {
    inserted_[p] = 1;
    conflicts_.clear();
    boundary_.clear();
    triangulation_.get_conflicts_and_boundary(position(p), std::back_inserter(conflicts_), std::back_inserter(boundary_), start);
    homeless_.clear();
    for (Face f : conflicts_) {
      for (std::uint32_t q = f->info().first; q != kNone; q = next_[q]) {
        if (q != p) homeless_.push_back(q);
      }
      f->info().first = kNone;
    }
    const Vertex v = triangulation_.star_hole(position(p), boundary_.begin(), boundary_.end(), conflicts_.begin(), conflicts_.end());
    resettle(v);
  }

  /// Gives every homeless point to the face of v's star that holds it.
  void resettle(Vertex v) {
    star_.clear();
    auto face = triangulation_.incident_faces(v), end = face;
    do {
      face->info().version += 1;
      face->info().first = kNone;
      if (!triangulation_.is_infinite(face)) star_.push_back({face, face->index(v)});
    } while (++face != end);
    const TraitsPoint centre = v->point();
    std::size_t at = 0;
    for (const std::uint32_t q : homeless_) {
      const TraitsPoint p = position(q);
      for (std::size_t tried = 0; tried < star_.size() && !in_wedge(star_[at], centre, p); ++tried) at = (at + 1) % star_.size();
      link(q, star_[at].face);
    }
    for (const StarFace& s : star_) enqueue(s.face);
  }

  struct StarFace {
    Face face;
    int centre;
  };

  static bool in_wedge(const StarFace& s, const TraitsPoint& centre, const TraitsPoint& p) {
    const TraitsPoint& right = s.face->vertex(Triangulation::ccw(s.centre))->point();
    const TraitsPoint& left = s.face->vertex(Triangulation::cw(s.centre))->point();
    return orientation(centre, right, p) >= 0 && orientation(centre, left, p) <= 0;
  }

  /// Finds the face's worst point and queues it.
  void enqueue(Face f) {
    const std::uint32_t first = f->info().first;
    if (first == kNone) return;
    const GridPoint &a = corner(f, 0), &b = corner(f, 1), &c = corner(f, 2);
    const double bx = static_cast<double>(b.x) - a.x, by = static_cast<double>(b.y) - a.y, bz = static_cast<double>(b.z) - a.z;
    const double cx = static_cast<double>(c.x) - a.x, cy = static_cast<double>(c.y) - a.y, cz = static_cast<double>(c.z) - a.z;
    const double area = bx * cy - by * cx;
    const double sx = (bz * cy - cz * by) / area, sy = (bx * cz - cx * bz) / area;
    double worst = -1;
    for (std::uint32_t q = first; q != kNone; q = next_[q]) {
      const GridPoint& p = points_[q];
      const double error = std::abs(static_cast<double>(p.z) - a.z - sx * (static_cast<double>(p.x) - a.x) - sy * (static_cast<double>(p.y) - a.y));
      if (error > worst || (error == worst && q < f->info().worst)) {
        worst = error;
        f->info().worst = q;
      }
    }
    queue_.push({worst, f->info().worst, f->info().version, f});
  }

  std::span<const GridPoint> points_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint8_t> inserted_;
  Triangulation triangulation_;
  std::priority_queue<Candidate> queue_;
  // Kept between insertions for their memory.
  std::vector<Face> conflicts_;
  std::vector<Triangulation::Edge> boundary_;
  std::vector<std::uint32_t> homeless_;
  std::vector<StarFace> star_;
};

/// Indices of the convex hull's vertices, without those inside its edges (A. M. Andrew's monotone chain).
std::vector<std::uint32_t> convex_hull(std::span<const GridPoint> points) {
  std::vector<std::uint32_t> order(points.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return points[a].x != points[b].x ? points[a].x < points[b].x : points[a].y < points[b].y;
  });
  std::vector<std::uint32_t> hull;
  for (int chain = 0; chain < 2; ++chain) {
    const std::size_t base = hull.size();
    for (const std::uint32_t p : order) {
      while (hull.size() >= base + 2 && orientation(points[hull[hull.size() - 2]], points[hull.back()], points[p]) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(order.begin(), order.end());
  }
  return hull;
}

}  // namespace

std::vector<std::uint8_t> greedy_levels(std::span<const GridPoint> points, std::span<const std::uint8_t> corners,
                                        std::span<const double> tolerances) {
  const int coarsest = static_cast<int>(tolerances.size()) - 1;
  std::vector<std::uint8_t> levels(points.size(), 0);
  std::vector<std::uint32_t> first = convex_hull(points);
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    if (corners[p]) first.push_back(p);
  }
  for (const std::uint32_t p : first) levels[p] = static_cast<std::uint8_t>(coarsest);
  GreedyInsertion greedy(points);
  if (!greedy.start(first)) return levels;
  for (int k = coarsest; k >= 1; --k) {
    greedy.refine(tolerances[k], [&](std::uint32_t p) { levels[p] = static_cast<std::uint8_t>(k); });
  }
  return levels;
}

}  // namespace itin
