// The full surface that greedy insertion approximates (greedy_insertion.hpp), by its triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "pyramid/difference/vertex_walk.hpp"
#include "pyramid/greedy/greedy_insertion.hpp"
#include "triangulate/region/region.hpp"

namespace itin {

/// Lists the open vertices of each coarse face, and walks along coarse edges from triangle to triangle.
class MeshGround {
 public:
  /// All arguments must outlive it.
  MeshGround(const RegionMesh& fine, std::span<const Candidacy> candidacy)
      : fine_(fine), candidacy_(candidacy), walk_(fine), next_(fine.vertices.size(), kNoVertex) {}

  const std::vector<SelectedVertex>& vertices() const { return fine_.vertices; }

  void begin(GrowingMesh& mesh, std::span<const std::uint32_t> open) {
    first_.assign(mesh.mesh().triangles.size(), kNoVertex);
    std::uint32_t near = 0;
    for (const std::uint32_t v : open) {
      near = mesh.triangle_at(position(v), near);
      link(v, near);
    }
  }

  void take(std::span<const std::uint32_t> faces, std::uint32_t v) {
    homeless_.clear();
    for (const std::uint32_t f : faces) {
      for (std::uint32_t q = std::exchange(first_[f], kNoVertex); q != kNoVertex; q = next_[q])
        if (q != v) homeless_.push_back(q);
    }
  }

  /// Gives every homeless vertex to the face of the star that holds it.
  void assign_to_star(const PlaneMesh& mesh, std::span<const std::uint32_t> star) {
    first_.resize(mesh.triangles.size(), kNoVertex);
    std::size_t at = 0;
    for (const std::uint32_t q : homeless_) {
      for (std::size_t tried = 0; tried < star.size() && !in_wedge(mesh.triangles[star[at]], position(q)); ++tried)
        at = (at + 1) % star.size();
      link(q, star[at]);
    }
  }

  WorstPoint worst_point(std::uint32_t face, const std::array<std::uint32_t, 3>& corners) const {
    const std::uint32_t first = first_[face];
    if (first == kNoVertex) return {};
    const GridPoint &a = point(corners[0]), &b = point(corners[1]), &c = point(corners[2]);
    const double bx = static_cast<double>(b.x) - a.x, by = static_cast<double>(b.y) - a.y,
                 bz = static_cast<double>(b.z) - a.z;
    const double cx = static_cast<double>(c.x) - a.x, cy = static_cast<double>(c.y) - a.y,
                 cz = static_cast<double>(c.z) - a.z;
    const double area = bx * cy - by * cx;
    const double sx = (bz * cy - cz * by) / area, sy = (bx * cz - cx * bz) / area;
    WorstPoint free{-1, kNoVertex}, spare{-1, kNoVertex};
    for (std::uint32_t q = first; q != kNoVertex; q = next_[q]) {
      const GridPoint& p = point(q);
      const double error = std::abs(static_cast<double>(p.z) - a.z - sx * (static_cast<double>(p.x) - a.x) -
                                    sy * (static_cast<double>(p.y) - a.y));
      WorstPoint& worst = candidacy_[q] == Candidacy::kSpare ? spare : free;
      if (error > worst.error || (error == worst.error && q < worst.point)) worst = {error, q};
    }
    return {std::max(free.error, spare.error), free.point != kNoVertex ? free.point : spare.point};
  }

  /// Offers, at a crossing with a full edge, the end of that edge nearer to it, or the other end, or a corner opposite.
  template <class Worst>
  void compare_edge(std::uint32_t a, std::uint32_t b, Worst& worst) const {
    const GridPoint &pa = point(a), &pb = point(b);
    walk_.walk(a, b, [&](std::uint32_t p, std::uint32_t q, std::uint32_t before, std::uint32_t behind) {
      const GridPoint &pp = point(p), &pq = point(q);
      const auto ap = static_cast<double>(doubled_area(pa, pb, pp)), aq = static_cast<double>(doubled_area(pa, pb, pq));
      const auto pqa = static_cast<double>(doubled_area(pp, pq, pa)),
                 pqb = static_cast<double>(doubled_area(pp, pq, pb));
      const double fine = pp.z + ap / (ap - aq) * (static_cast<double>(pq.z) - pp.z);
      const double coarse = pa.z + pqa / (pqa - pqb) * (static_cast<double>(pb.z) - pa.z);
      const double error = std::abs(fine - coarse);
      if (!worst.asks_for(error)) return;
      const bool nearer_p = std::abs(ap) <= std::abs(aq);
      worst.offer(error, {nearer_p ? p : q, nearer_p ? q : p, opposite(before, p, q), opposite(behind, p, q)});
    });
  }

 private:
  const GridPoint& point(std::uint32_t v) const { return fine_.vertices[v].point; }
  Position position(std::uint32_t v) const { return fine_.vertices[v].position(); }

  void link(std::uint32_t v, std::uint32_t face) { next_[v] = std::exchange(first_[face], v); }

  /// Tells whether a position lies ahead of the last corner of a face of the star, between the other two.
  bool in_wedge(const std::array<std::uint32_t, 3>& corners, Position p) const {
    const Position centre = position(corners[2]);
    return orientation(centre, position(corners[0]), p) >= 0 && orientation(centre, position(corners[1]), p) <= 0;
  }

  std::uint32_t opposite(std::uint32_t triangle, std::uint32_t p, std::uint32_t q) const {
    if (triangle == kNoTriangle) return kNoVertex;
    const auto& [a, b, c] = fine_.mesh.triangles[triangle];
    return a != p && a != q ? a : b != p && b != q ? b : c;
  }

  const RegionMesh& fine_;
  std::span<const Candidacy> candidacy_;
  VertexWalk walk_;
  std::vector<std::uint32_t> first_;     ///< by face: the first open vertex in it
  std::vector<std::uint32_t> next_;      ///< by vertex: the next one in its face
  std::vector<std::uint32_t> homeless_;  ///< vertices of the faces that were taken
};

}  // namespace itin
