// Greedy insertion into a Delaunay triangulation (Garland and Heckbert 1995), over whatever surface is approximated.
//
//   GreedyInsertion<MeshGround> greedy(ground, candidacy, tolerances);
//
// A ground knows the full surface and its vertices, by number, and says how far a coarse face or edge is off it:
//   vertices()                  the vertices
//   begin(mesh, open)           called before the first face is looked at, with the open vertices
//   take(faces, v)              called when the star about vertex v has replaced these faces of the mesh
//   assign_to_star(mesh, star)  called after that, with the star's faces: they share the vertices of the faces replaced
//   worst_point(face, corners)  how far open vertices in the face are off it, and the one to take: the farthest free
//                               one, or the farthest of all where none is free
//   compare_edge(a, b, worst)   offers worst what would break up edge ab where it crosses full edges
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <itin/sort_unique.hpp>

#include "pyramid/greedy/greedy.hpp"
#include "triangulate/mesh/delaunay.hpp"
#include "triangulate/mesh/growing_mesh.hpp"

namespace itin {

/// How far vertices are off, and the one to take; kNoVertex where there is none.
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
  std::uint32_t face;      ///< kNoTriangle for an edge's proposal
  std::uint32_t from, to;  ///< the ends of the edge
  bool of_edge() const { return face == kNoTriangle; }
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
      : ground_(ground), candidacy_(candidacy), mesh_(ground.vertices()), insertions_(tolerances) {}

  /// Starts from these vertices, whose hull must contain all candidates; false while they are collinear.
  bool start(std::vector<std::uint32_t> vertices) {
    sort_unique(vertices);
    std::vector<Position> positions;
    for (const std::uint32_t v : vertices) positions.push_back(ground_.vertices()[v].position());
    Delaunay delaunay;
    delaunay.insert(positions, vertices);
    mesh_.start(delaunay.mesh());
    const auto faces = static_cast<std::uint32_t>(mesh_.mesh().triangles.size());
    if (faces == 0) return false;
    versions_.assign(faces, 0);
    std::vector<std::uint32_t> open;
    for (std::uint32_t v = 0; v < candidacy_.size(); ++v)
      if (is_open(v)) open.push_back(v);
    ground_.begin(mesh_, open);
    for (std::uint32_t f = 0; f < faces; ++f) propose_worst_point(f);
    for (std::uint32_t f = 0; f < faces; ++f) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::array<std::uint32_t, 3>& corners = mesh_.mesh().triangles[f];
        const std::uint32_t from = corners[(i + 1) % 3], to = corners[(i + 2) % 3];
        if (from < to || mesh_.mesh().neighbours[f][i] == kNoTriangle) propose_edge(from, to);
      }
    }
    return true;
  }

  /// Begins a level: to be called before its vertices are inserted, from the coarsest level to level 1.
  void begin_level(std::size_t level) {
    insertions_.begin_level(level, [&](const Insertion& insertion) { return is_stale(insertion); });
  }

  /// Inserts these vertices, if they are not yet in.
  void insert_given(const std::vector<std::uint32_t>& vertices) {
    for (const std::uint32_t v : vertices)
      if (!mesh_.has(v)) insert(v, mesh_.triangle_at(position(v)));
  }

  /// Inserts the worst vertex until nothing is more than the level's tolerance off; calls on_insert(vertex) for each.
  template <class OnInsert>
  void refine(const OnInsert& on_insert) {
    while (const auto worst = insertions_.pop()) {
      if (is_stale(*worst)) continue;
      const bool of_edge = worst->of_edge();
      if (!mesh_.has(worst->point)) {
        insert(worst->point,
               of_edge ? mesh_.triangle_at(position(worst->point), mesh_.triangle_of(worst->from)) : worst->face);
        on_insert(worst->point);
      }
      // An edge that has outlived the insertion needs another one.
      if (of_edge && !is_stale(*worst)) propose_edge(worst->from, worst->to);
    }
  }

 private:
  Position position(std::uint32_t v) const { return ground_.vertices()[v].position(); }
  bool is_open(std::uint32_t v) const { return !mesh_.has(v) && candidacy_[v] != Candidacy::kNone; }
  /// Whether the insertion's face or edge is no more.
  bool is_stale(const Insertion& insertion) const {
    return insertion.of_edge() ? !mesh_.has_edge(insertion.from, insertion.to)
                               : versions_[insertion.face] != insertion.version;
  }

  /// Inserts v, given a face that holds it.
  void insert(std::uint32_t v, std::uint32_t face) {
    mesh_.insert(v, face);
    ground_.take(mesh_.replaced(), v);
    versions_.resize(mesh_.mesh().triangles.size());
    for (const std::uint32_t f : mesh_.star()) ++versions_[f];
    ground_.assign_to_star(mesh_.mesh(), mesh_.star());
    for (const std::uint32_t f : mesh_.star()) propose_worst_point(f);
    for (const std::uint32_t f : mesh_.star()) {
      const auto& [from, to, centre] = mesh_.mesh().triangles[f];
      propose_edge(centre, from);
      // At the hull, the last face has an edge that no other face has.
      if (mesh_.mesh().neighbours[f][0] == kNoTriangle) propose_edge(centre, to);
    }
  }

  void propose_worst_point(std::uint32_t face) {
    const WorstPoint worst = ground_.worst_point(face, mesh_.mesh().triangles[face]);
    if (worst.point != kNoVertex)
      insertions_.push({worst.error - kPointError, worst.point, versions_[face], face, kNoVertex, kNoVertex});
  }

  /// The place where an edge is most off, among the places at which a vertex would break it up.
  class WorstCrossing {
   public:
    explicit WorstCrossing(const GreedyInsertion& greedy) : greedy_(greedy) {}
    bool asks_for(double error) const {
      return error > worst_.error && greedy_.insertions_.asks_for(error + kCrossingError);
    }
    /// Offers a place; the first of these vertices that is open and free, or else open, is the remedy. To be called
    /// after asks_for(error).
    void offer(double error, std::initializer_list<std::uint32_t> vertices) {
      std::uint32_t remedy = kNoVertex;
      for (const std::uint32_t v : vertices) {
        if (v == kNoVertex || !greedy_.is_open(v)) continue;
        const bool spare = greedy_.candidacy_[v] == Candidacy::kSpare;
        if (!spare || remedy == kNoVertex) remedy = v;
        if (!spare) break;
      }
      if (remedy != kNoVertex) worst_ = {error, remedy};
    }
    const WorstPoint& found() const { return worst_; }

   private:
    const GreedyInsertion& greedy_;
    WorstPoint worst_{-1, kNoVertex};
  };

  /// Proposes a vertex that would break up this edge.
  void propose_edge(std::uint32_t a, std::uint32_t b) {
    WorstCrossing worst(*this);
    ground_.compare_edge(std::min(a, b), std::max(a, b), worst);
    const auto& [error, remedy] = worst.found();
    if (remedy != kNoVertex) insertions_.push({error + kCrossingError, remedy, 0, kNoTriangle, a, b});
  }

  Ground& ground_;
  std::span<const Candidacy> candidacy_;
  GrowingMesh mesh_;
  std::vector<std::uint32_t> versions_;  ///< by face: counts its replacements, to recognise stale proposals
  Insertions insertions_;
};

}  // namespace itin
