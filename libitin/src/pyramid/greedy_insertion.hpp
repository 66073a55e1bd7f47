// Greedy insertion into a Delaunay triangulation (Garland and Heckbert 1995), over whatever surface is approximated.
//
//   GreedyInsertion<MeshGround> greedy(ground, candidacy, tolerances);
//
// A ground knows the full surface and its vertices, by number, and says how far a coarse face or edge is off it:
//   point(v), size()                the vertices
//   begin(triangulation, open)      called before the first face is looked at
//   take(faces, v)                  called before the star about vertex v replaces these faces
//   assign_to_star(centre, faces)   called with the star's faces, which share the vertices of the faces replaced
//   worst_point(face)               the open vertex in the face that is farthest off it
//   compare_edge(a, b, worst)       offers worst what would break up edge ab where it crosses full edges
// Include only where CGAL may appear.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_2.h>

#include "pyramid/greedy.hpp"
#include "triangulate/cgal_traits.hpp"

namespace itin {

struct CoarseFaceInfo {
  std::uint32_t first = kNoVertex;  ///< the first vertex that lies in the face, where the ground lists these
  std::uint32_t version = 0;        ///< counts the face's reincarnations, to recognise stale proposals
};

using CoarseTriangulation = CGAL::Delaunay_triangulation_2<
    GridTraits,
    CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_2<GridTraits>,
                                         CGAL::Triangulation_face_base_with_info_2<CoarseFaceInfo, GridTraits>>>;
using CoarseFace = CoarseTriangulation::Face_handle;

/// Finds a finite face that holds p. A point on the hull may be found in an infinite face, whose neighbour holds it,
/// too.
inline CoarseFace locate(const CoarseTriangulation& triangulation, const TraitsPoint& p, CoarseFace hint) {
  const CoarseFace f = triangulation.locate(p, hint);
  return triangulation.is_infinite(f) ? f->neighbor(f->index(triangulation.infinite_vertex())) : f;
}

/// A face of the star about a vertex that was inserted.
struct StarFace {
  CoarseFace face;
  TraitsPoint right, left;  ///< as seen from the vertex
};

/// A vertex and how far it is off; kNoVertex where there is none.
struct WorstPoint {
  double error = 0;
  std::uint32_t point = kNoVertex;
};

// Heights are whole units, so differences are often exactly a tolerance. Verification decides points exactly and rounds
// crossings outwards; these margins make greedy insertion decide alike.
inline constexpr double kPointError = 1e-6;
inline constexpr double kCrossingError = 2e-5;

/// A vertex to insert: the worst one of a face, or one that breaks up the worst edge between two vertices.
struct Insertion {
  double error;
  std::uint32_t point;
  std::uint32_t version;   ///< the face's, when this was proposed
  CoarseFace face;         ///< null for an edge's proposal
  std::uint32_t from, to;  ///< the ends of the edge
  bool of_edge() const { return face == CoarseFace(); }
  /// Compares by the greatest error first, then by the first vertex; the rest only makes the order unique.
  bool operator<(const Insertion& p) const {
    if (error != p.error) return error < p.error;
    if (point != p.point) return point > p.point;
    return std::tuple(of_edge(), from, to) > std::tuple(p.of_edge(), p.from, p.to);
  }
};

/// The insertions to come, level by level: a level's queue holds nothing that waits for a finer level.
class Insertions {
 public:
  /// `tolerances` are ascending, level 0 first. Begins with the coarsest level.
  explicit Insertions(std::span<const double> tolerances)
      : tolerances_(tolerances), level_(tolerances.size() - 1), waiting_(tolerances.size()) {}

  /// Whether any level asks for a vertex that is so far off.
  bool asks_for(double error) const { return tolerances_.size() > 1 && error > tolerances_[1]; }

  /// Adds an insertion; one that no level asks for is forgotten.
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

  /// Takes the worst insertion that is more than this level's tolerance off; nothing where there is none.
  std::optional<Insertion> pop() {
    if (queue_.empty()) return std::nullopt;
    std::pop_heap(queue_.begin(), queue_.end());
    const Insertion worst = queue_.back();
    queue_.pop_back();
    return worst;
  }

  /// Begins the given level, the next finer one. Forgets insertions for which is_stale() holds.
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

/// `Ground` is a class as described above.
template <class Ground>
class GreedyInsertion {
 public:
  /// All arguments must outlive it.
  GreedyInsertion(Ground& ground, std::span<const Candidacy> candidacy, std::span<const double> tolerances)
      : ground_(ground), candidacy_(candidacy), vertices_(ground.size()), insertions_(tolerances) {}

  /// Starts from these vertices, whose hull must contain all candidates; false while they are collinear.
  bool start(const std::vector<std::uint32_t>& vertices) {
    Face hint;
    for (const std::uint32_t v : vertices) {
      if (is_inserted(v)) continue;
      vertices_[v] = triangulation_.insert(position(v), hint);
      hint = vertices_[v]->face();
    }
    if (triangulation_.dimension() < 2) return false;
    std::vector<std::uint32_t> open;
    for (std::uint32_t v = 0; v < candidacy_.size(); ++v)
      if (is_open(v)) open.push_back(v);
    ground_.begin(triangulation_, open);
    for (Face f : triangulation_.finite_face_handles()) propose_worst_point(f);
    for (const auto& edge : triangulation_.finite_edges()) {
      propose_edge(edge.first->vertex(CoarseTriangulation::ccw(edge.second)),
                   edge.first->vertex(CoarseTriangulation::cw(edge.second)));
    }
    return true;
  }

  /// Begins a level: to be called before its vertices are inserted, from the coarsest level to level 1.
  void begin_level(std::size_t level) {
    insertions_.begin_level(level, [&](const Insertion& insertion) { return is_stale(insertion); });
  }

  /// Inserts these vertices, if they are not yet in.
  void insert_given(const std::vector<std::uint32_t>& vertices) {
    Face hint;
    for (const std::uint32_t v : vertices) {
      if (is_inserted(v)) continue;
      hint = locate(triangulation_, position(v), hint);
      hint = insert(v, hint);
    }
  }

  /// Inserts the worst vertex until nothing is more than the level's tolerance off; calls on_insert(vertex) for each.
  template <class OnInsert>
  void refine(const OnInsert& on_insert) {
    while (const auto worst = insertions_.pop()) {
      if (is_stale(*worst)) continue;
      const bool of_edge = worst->of_edge();
      if (!is_inserted(worst->point)) {
        insert(worst->point,
               of_edge ? locate(triangulation_, position(worst->point), vertices_[worst->from]->face()) : worst->face);
        on_insert(worst->point);
      }
      // An edge that has outlived the insertion needs another one.
      if (of_edge && !is_stale(*worst)) propose_edge(vertices_[worst->from], vertices_[worst->to]);
    }
  }

 private:
  using Face = CoarseFace;
  using Vertex = CoarseTriangulation::Vertex_handle;

  TraitsPoint position(std::uint32_t v) const { return {ground_.point(v).x, ground_.point(v).y, v}; }
  bool is_inserted(std::uint32_t v) const { return vertices_[v] != Vertex(); }
  bool is_open(std::uint32_t v) const { return !is_inserted(v) && candidacy_[v] != Candidacy::kNone; }
  /// Whether the insertion's face or edge is no more.
  bool is_stale(const Insertion& insertion) const {
    return insertion.of_edge() ? !triangulation_.is_edge(vertices_[insertion.from], vertices_[insertion.to])
                               : insertion.face->info().version != insertion.version;
  }

  /// Inserts v and returns a face at it.
  Face insert(std::uint32_t v, Face start) {
    conflicts_.clear();
    boundary_.clear();
    triangulation_.get_conflicts_and_boundary(position(v), std::back_inserter(conflicts_),
                                              std::back_inserter(boundary_), start);
    ground_.take(conflicts_, v);
    vertices_[v] =
        triangulation_.star_hole(position(v), boundary_.begin(), boundary_.end(), conflicts_.begin(), conflicts_.end());
    update_star(vertices_[v]);
    return vertices_[v]->face();
  }

  void update_star(Vertex centre) {
    star_.clear();
    auto face = triangulation_.incident_faces(centre), end = face;
    do {
      face->info() = {kNoVertex, face->info().version + 1};
      if (triangulation_.is_infinite(face)) continue;
      const int i = face->index(centre);
      star_.push_back({face, face->vertex(CoarseTriangulation::ccw(i))->point(),
                       face->vertex(CoarseTriangulation::cw(i))->point()});
    } while (++face != end);
    ground_.assign_to_star(centre->point(), star_);
    for (const StarFace& s : star_) propose_worst_point(s.face);
    auto neighbour = triangulation_.incident_vertices(centre), last = neighbour;
    do {
      if (!triangulation_.is_infinite(neighbour)) propose_edge(centre, neighbour);
    } while (++neighbour != last);
  }

  void propose_worst_point(Face face) {
    const WorstPoint worst = ground_.worst_point(face);
    if (worst.point != kNoVertex)
      insertions_.push({worst.error - kPointError, worst.point, face->info().version, face, kNoVertex, kNoVertex});
  }

  /// The place where an edge is most off, among the places at which a vertex would break it up.
  class WorstCrossing {
   public:
    explicit WorstCrossing(const GreedyInsertion& greedy) : greedy_(greedy) {}
    bool asks_for(double error) const {
      return error > worst_.error && greedy_.insertions_.asks_for(error + kCrossingError);
    }
    /// Offers a place; the first of these vertices that is open is the remedy. To be called after asks_for(error).
    void offer(double error, std::initializer_list<std::uint32_t> vertices) {
      const auto remedy = std::find_if(vertices.begin(), vertices.end(),
                                       [&](std::uint32_t v) { return v != kNoVertex && greedy_.is_open(v); });
      if (remedy != vertices.end()) worst_ = {error, *remedy};
    }
    const WorstPoint& found() const { return worst_; }

   private:
    const GreedyInsertion& greedy_;
    WorstPoint worst_{-1, kNoVertex};
  };

  /// Proposes a vertex that would break up this edge.
  void propose_edge(Vertex from, Vertex to) {
    const std::uint32_t a = from->point().vertex, b = to->point().vertex;
    WorstCrossing worst(*this);
    ground_.compare_edge(std::min(a, b), std::max(a, b), worst);
    const auto& [error, remedy] = worst.found();
    if (remedy != kNoVertex) insertions_.push({error + kCrossingError, remedy, 0, Face(), a, b});
  }

  Ground& ground_;
  std::span<const Candidacy> candidacy_;
  CoarseTriangulation triangulation_;
  std::vector<Vertex> vertices_;  ///< by vertex of the ground; null until it is inserted
  Insertions insertions_;
  // These are kept between insertions for their memory.
  std::vector<Face> conflicts_;
  std::vector<CoarseTriangulation::Edge> boundary_;
  std::vector<StarFace> star_;
};

}  // namespace itin
