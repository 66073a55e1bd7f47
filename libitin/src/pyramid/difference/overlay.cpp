#include "pyramid/difference/overlay.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <itin/error.hpp>

#include "geometry/whole_division.hpp"

namespace itin {

namespace {

/// How far v lies above the triangle's plane. The weights are exact, so the double result is off by less than 1e-6.
/// Next to a whole number integers decide.
DifferenceRange above_plane(const RegionMesh& m, std::uint32_t triangle, const GridPoint& v) {
  const auto& [a, b, c] = m.mesh.triangles[triangle];
  const GridPoint &pa = m.vertices[a].point, &pb = m.vertices[b].point, &pc = m.vertices[c].point;
  const std::int64_t wa = doubled_area(v, pb, pc), wb = doubled_area(pa, v, pc), wc = doubled_area(pa, pb, v);
  const double above = (static_cast<double>(wa) * (v.z - static_cast<double>(pa.z)) +
                        static_cast<double>(wb) * (v.z - static_cast<double>(pb.z)) +
                        static_cast<double>(wc) * (v.z - static_cast<double>(pc.z))) /
                       (static_cast<double>(wa) + static_cast<double>(wb) + static_cast<double>(wc));
  const double below = std::floor(above);
  if (above - below > 1e-5 && above - below < 1 - 1e-5) {
    return {static_cast<std::int32_t>(below), static_cast<std::int32_t>(below) + 1};
  }
  const Int128 weight = Int128{wa} + wb + wc,
               numerator = v.z * weight - (Int128{wa} * pa.z + Int128{wb} * pb.z + Int128{wc} * pc.z);
  return {static_cast<std::int32_t>(floor_divide(numerator, weight)),
          static_cast<std::int32_t>(ceil_divide(numerator, weight))};
}

/// T0 - Tk where fine edge uv crosses coarse edge pq. The weights are exact and heights below 2^31, so rounding stays
/// below 1e-5.
DifferenceRange above_crossing(const GridPoint& u, const GridPoint& v, const GridPoint& p, const GridPoint& q) {
  const auto pu = static_cast<double>(doubled_area(p, q, u)), pv = static_cast<double>(doubled_area(p, q, v));
  const auto up = static_cast<double>(doubled_area(u, v, p)), uq = static_cast<double>(doubled_area(u, v, q));
  const double along_fine = pu / (pu - pv), along_coarse = up / (up - uq);
  const double d =
      (u.z + along_fine * (static_cast<double>(v.z) - u.z)) - (p.z + along_coarse * (static_cast<double>(q.z) - p.z));
  return {static_cast<std::int32_t>(std::floor(d - 1e-5)), static_cast<std::int32_t>(std::ceil(d + 1e-5))};
}

/// Follows fine edges through the coarse mesh.
class CoarseWalk {
 public:
  explicit CoarseWalk(const RegionMesh& coarse) : coarse_(coarse), mesh_(coarse.mesh) { find_pinches(); }

  bool contains(std::uint32_t t, Position p) const {
    for (int i = 0; i < 3; ++i) {
      if (outside(t, i, p)) return false;
    }
    return true;
  }

  /// Calls on_crossing(p, q) for every coarse edge pq that uv crosses properly, where `face` holds u, and returns a
  /// face that holds v. No coarse vertex lies strictly between u and v, for uv is an edge of a finer triangulation.
  template <class OnCrossing>
  std::uint32_t walk(Position u, bool from_coarse_vertex, std::uint32_t face, Position v,
                     const OnCrossing& on_crossing) const {
    Exit exit = from_coarse_vertex ? leave_vertex(u, face, v) : leave_start(u, face, v);
    while (exit.edge != kStays) {
      const std::uint32_t p = mesh_.triangles[exit.face][next(exit.edge)],
                          q = mesh_.triangles[exit.face][previous(exit.edge)];
      on_crossing(p, q);
      exit = leave_entered(u, beyond(exit), q, v);
    }
    return exit.face;
  }

 private:
  /// The edge through which uv leaves the face, or kStays where v lies in it.
  struct Exit {
    std::uint32_t face;
    int edge;
  };
  static constexpr int kStays = -1, kBoth = 3;

  static int next(int i) { return i == 2 ? 0 : i + 1; }
  static int previous(int i) { return i == 0 ? 2 : i - 1; }
  Position corner(std::uint32_t t, int i) const { return coarse_.vertices[mesh_.triangles[t][i]].position(); }
  bool outside(std::uint32_t t, int edge, Position p) const {
    return orientation(corner(t, next(edge)), corner(t, previous(edge)), p) < 0;
  }

  std::uint32_t beyond(Exit exit) const {
    const std::uint32_t neighbour = mesh_.neighbours[exit.face][exit.edge];
    if (neighbour == kNoTriangle) throw Error("the coarse surface does not cover the full one");
    return neighbour;
  }

  /// v lies beyond both edges at corner i: uv leaves by the edge on the side of the corner where it passes.
  Exit leave_around(Position u, std::uint32_t t, int i, Position v) const {
    return {t, orientation(u, v, corner(t, i)) > 0 ? next(i) : previous(i)};
  }

  /// uv enters face t through its edge that starts at vertex `first`.
  Exit leave_entered(Position u, std::uint32_t t, std::uint32_t first, Position v) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    const int entered = first == b ? 0 : first == c ? 1 : 2;
    const bool right = outside(t, next(entered), v), left = outside(t, previous(entered), v);
    if (right && left) return leave_around(u, t, entered, v);
    return {t, right ? next(entered) : left ? previous(entered) : kStays};
  }

  /// u lies in face t, perhaps on an edge, and is no corner.
  Exit leave_start(Position u, std::uint32_t t, Position v) const {
    int inside = 0, last = kStays;
    for (int i = 0; i < 3; ++i) {
      if (!outside(t, i, v)) {
        inside = i;
        continue;
      }
      if (orientation(corner(t, next(i)), corner(t, previous(i)), u) == 0)  // u is on the very edge: nothing is crossed
        return leave_entered(u, beyond({t, i}), mesh_.triangles[t][previous(i)], v);
      last = last == kStays ? i : kBoth;
    }
    // A v that lies beyond all edges but one lies beyond both edges at the corner opposite that one.
    return last == kBoth ? leave_around(u, t, inside, v) : Exit{t, last};
  }

  /// u is a corner of face `start`.
  Exit leave_vertex(Position u, std::uint32_t start, Position v) const {
    if (const auto exit = leave_fan(u, start, v)) return *exit;
    const auto [first, last] = pinched_.equal_range(mesh_.triangles[start][corner_at(start, u)]);
    for (auto fan = first; fan != last; ++fan) {
      if (const auto exit = leave_fan(u, fan->second, v)) return *exit;
    }
    throw Error("lost the way through the coarse surface");
  }

  int corner_at(std::uint32_t t, Position u) const { return corner(t, 0) == u ? 0 : corner(t, 1) == u ? 1 : 2; }

  /// Finds the exit through the triangles that hang together about u.
  std::optional<Exit> leave_fan(Position u, std::uint32_t start, Position v) const {
    for (const int step : {1, 2}) {  // counterclockwise, and then clockwise from the start if a border stopped that
      std::uint32_t t = start;
      do {
        const int i = corner_at(t, u);
        const Position p = corner(t, next(i)), q = corner(t, previous(i));
        if (orientation(u, p, v) >= 0 && orientation(u, v, q) >= 0)
          return Exit{t, orientation(p, q, v) >= 0 ? kStays : i};
        t = mesh_.neighbours[t][(i + step) % 3];
      } while (t != kNoTriangle && t != start);
    }
    return std::nullopt;
  }

  /// Where ground meets ground at a single vertex, as voids do corner to corner, its triangles are several fans.
  void find_pinches() {
    std::vector<std::uint32_t> fan(coarse_.vertices.size(), kNoTriangle);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (int i = 0; i < 3; ++i) {
        if (mesh_.neighbours[t][previous(i)] != kNoTriangle) continue;  // each fan has one where turning back ends
        const std::uint32_t v = mesh_.triangles[t][i];
        if (fan[v] == kNoTriangle) {
          fan[v] = t;
        } else {
          if (!pinched_.contains(v)) pinched_.emplace(v, fan[v]);
          pinched_.emplace(v, t);
        }
      }
    }
  }

  const RegionMesh& coarse_;
  const PlaneMesh& mesh_;
  std::multimap<std::uint32_t, std::uint32_t> pinched_;  ///< vertices, and a triangle of each of their fans
};

class DifferenceSweep {
 public:
  DifferenceSweep(const RegionMesh& fine, const FineEdges& edges, const RegionMesh& coarse, std::int32_t allowed)
      : fine_(fine),
        edges_(edges),
        coarse_(coarse),
        allowed_(allowed),
        walk_(coarse),
        visited_(fine.vertices.size(), 0) {
    face_.assign(fine.vertices.size(), kNoTriangle);
    at_vertex_.resize(fine.vertices.size());
    is_coarse_vertex_.assign(fine.vertices.size(), 0);
    result_.along_edge.resize(edges.edges().size());
  }

  Difference run() {
    seed_at_coarse_vertices();
    for (std::uint32_t v = 0; v < face_.size(); ++v) {
      // Vertices are visited breadth first; one that no coarse vertex reaches is located the slow way.
      if (visited_[v]) continue;
      if (face_[v] == kNoTriangle) locate(v);
      spread_from(v);
    }
    find_worst_of_faces();
    return std::move(result_);
  }

 private:
  void seed_at_coarse_vertices() {
    std::vector<std::uint32_t> some_face(coarse_.vertices.size(), kNoTriangle);
    for (std::uint32_t t = 0; t < coarse_.mesh.triangles.size(); ++t) {
      for (const std::uint32_t v : coarse_.mesh.triangles[t]) some_face[v] = t;
    }
    std::uint32_t c = 0;
    for (std::uint32_t v = 0; v < face_.size(); ++v) {
      const std::uint64_t code = code_of(fine_.vertices[v]);
      while (c < coarse_.vertices.size() && code_of(coarse_.vertices[c]) < code) ++c;
      if (c == coarse_.vertices.size() || code_of(coarse_.vertices[c]) != code) continue;
      place_vertex(v, some_face[c]);
      is_coarse_vertex_[v] = 1;
    }
  }

  void place_vertex(std::uint32_t v, std::uint32_t face) {
    face_[v] = face;
    at_vertex_[v] = above_plane(coarse_, face, fine_.vertices[v].point);
  }

  void locate(std::uint32_t v) {
    for (std::uint32_t t = 0; t < coarse_.mesh.triangles.size(); ++t) {
      if (walk_.contains(t, fine_.vertices[v].position())) return place_vertex(v, t);
    }
    throw Error("the coarse surface does not cover the full one");
  }

  void spread_from(std::uint32_t first) {
    std::vector<std::uint32_t> queue{first};
    visited_[first] = 1;
    for (std::size_t at = 0; at < queue.size(); ++at) {
      const std::uint32_t u = queue[at];
      for (const std::uint32_t e : edges_.at_vertex(u)) {
        const std::uint32_t v = edges_.edges()[e].u == u ? edges_.edges()[e].v : edges_.edges()[e].u;
        follow(e, u, v);
        if (!visited_[v]) {
          visited_[v] = 1;
          queue.push_back(v);
        }
      }
    }
  }

  void follow(std::uint32_t e, std::uint32_t u, std::uint32_t v) {
    DifferenceRange& range = result_.along_edge[e];
    if (!range.empty()) return;  // it was followed from its other end
    const GridPoint &pu = fine_.vertices[u].point, &pv = fine_.vertices[v].point;
    if (face_[v] == face_[u]) {  // a triangle is convex: nothing is crossed
      range.add(at_vertex_[u]);
      range.add(at_vertex_[v]);
      return;
    }
    const std::uint32_t end = walk_.walk(Position{pu.x, pu.y}, is_coarse_vertex_[u] != 0, face_[u],
                                         Position{pv.x, pv.y}, [&](std::uint32_t p, std::uint32_t q) {
                                           const GridPoint &pp = coarse_.vertices[p].point,
                                                           &pq = coarse_.vertices[q].point;
                                           const DifferenceRange d = above_crossing(pu, pv, pp, pq);
                                           range.add(d);
                                           if (d.size() > allowed_) note(e, std::minmax(p, q), d.size());
                                         });
    if (face_[v] == kNoTriangle) place_vertex(v, end);
    range.add(at_vertex_[u]);
    range.add(at_vertex_[v]);
  }

  void note(std::uint32_t e, std::pair<std::uint32_t, std::uint32_t> coarse_edge, std::int32_t size) {
    const FineEdges::Edge& edge = edges_.edges()[e];
    const GridPoint &from = coarse_.vertices[coarse_edge.first].point, &to = coarse_.vertices[coarse_edge.second].point;
    // Where both ends are equally near, the one with the lesser code counts, in whatever region that is asked.
    const auto distance = [&](std::uint32_t v) {
      return std::pair(std::abs(doubled_area(from, to, fine_.vertices[v].point)), v);
    };
    const auto code = [&](std::uint32_t v) { return code_of(fine_.vertices[v]); };
    const auto [nearer, farther] =
        distance(edge.u) < distance(edge.v) ? std::pair(edge.u, edge.v) : std::pair(edge.v, edge.u);
    const std::uint64_t corner = code(corner_opposite(edge, edge.triangle)),
                        other = edge.other == kNoTriangle ? corner : code(corner_opposite(edge, edge.other));
    result_.failures.crossings.push_back(
        {coarse_edge.first,
         coarse_edge.second,
         size,
         {code(nearer), code(farther), std::min(corner, other), std::max(corner, other)}});
  }

  std::uint32_t corner_opposite(const FineEdges::Edge& edge, std::uint32_t t) const {
    const auto& corners = fine_.mesh.triangles[t];
    return *std::find_if(corners.begin(), corners.end(), [&](std::uint32_t v) { return v != edge.u && v != edge.v; });
  }

  void find_worst_of_faces() {
    std::vector<WorstVertex> worst(coarse_.mesh.triangles.size());
    for (std::uint32_t v = 0; v < at_vertex_.size(); ++v) {
      if (at_vertex_[v].size() > allowed_) worst[face_[v]].add(at_vertex_[v].size(), code_of(fine_.vertices[v]));
    }
    for (const WorstVertex& w : worst)
      if (w.found()) result_.failures.worst_of_faces.push_back(w.code());
  }

  const RegionMesh& fine_;
  const FineEdges& edges_;
  const RegionMesh& coarse_;
  std::int32_t allowed_;
  CoarseWalk walk_;
  std::vector<DifferenceRange> at_vertex_;      ///< T0 - Tk at each vertex of the fine mesh
  std::vector<std::uint32_t> face_;             ///< a coarse triangle that holds each fine vertex
  std::vector<std::uint8_t> is_coarse_vertex_;  ///< by fine vertex
  std::vector<std::uint8_t> visited_;
  Difference result_;
};

}  // namespace

FineEdges::FineEdges(const RegionMesh& fine) {
  const PlaneMesh& mesh = fine.mesh;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t n = mesh.neighbours[t][i];
      if (n != kNoTriangle && n < t) continue;
      edges_.push_back({mesh.triangles[t][(i + 1) % 3], mesh.triangles[t][(i + 2) % 3], t, n});
    }
  }
  at_vertex_ = {fine.vertices.size(), edges_.size(),
                [this](std::uint32_t e, const auto& add) { add(edges_[e].u), add(edges_[e].v); }};
}

Difference difference(const RegionMesh& fine, const FineEdges& edges, const RegionMesh& coarse, std::int32_t allowed) {
  return DifferenceSweep(fine, edges, coarse, allowed).run();
}

std::vector<DifferenceRange> over_triangles(const RegionMesh& fine, const FineEdges& edges,
                                            const Difference& difference) {
  std::vector<DifferenceRange> ranges(fine.mesh.triangles.size());
  for (std::uint32_t e = 0; e < difference.along_edge.size(); ++e) {
    const FineEdges::Edge& edge = edges.edges()[e];
    ranges[edge.triangle].add(difference.along_edge[e]);
    if (edge.other != kNoTriangle) ranges[edge.other].add(difference.along_edge[e]);
  }
  return ranges;
}

}  // namespace itin
