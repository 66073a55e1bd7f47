// The full surface that greedy insertion approximates (greedy_insertion.hpp), by its triangles.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "pyramid/greedy_insertion.hpp"
#include "pyramid/vertex_walk.hpp"
#include "triangulate/region.hpp"

namespace itin {

/// Lists the open vertices of each coarse face, and walks along coarse edges from triangle to triangle.
class MeshGround {
 public:
  /// The surface must outlive it.
  explicit MeshGround(const RegionMesh& fine) : fine_(fine), walk_(fine), next_(fine.vertices.size(), kNoVertex) {}

  std::size_t size() const { return fine_.vertices.size(); }
  const GridPoint& point(std::uint32_t v) const { return fine_.vertices[v].point; }

  void begin(const CoarseTriangulation& triangulation, std::span<const std::uint32_t> open) {
    CoarseFace hint;
    for (const std::uint32_t v : open) {
      hint = locate(triangulation, position(v), hint);
      link(v, hint);
    }
  }

  void take(std::span<const CoarseFace> faces, std::uint32_t v) {
    homeless_.clear();
    for (const CoarseFace& f : faces) {
      for (std::uint32_t q = f->info().first; q != kNoVertex; q = next_[q])
        if (q != v) homeless_.push_back(q);
    }
  }

  /// Gives every homeless vertex to the face of the star that holds it.
  void assign_to_star(const TraitsPoint& centre, std::span<const StarFace> star) {
    std::size_t at = 0;
    for (const std::uint32_t q : homeless_) {
      const TraitsPoint p = position(q);
      for (std::size_t tried = 0; tried < star.size() && !in_wedge(star[at], centre, p); ++tried)
        at = (at + 1) % star.size();
      link(q, star[at].face);
    }
  }

  WorstPoint worst_point(CoarseFace f) const {
    const std::uint32_t first = f->info().first;
    if (first == kNoVertex) return {};
    const GridPoint &a = corner(f, 0), &b = corner(f, 1), &c = corner(f, 2);
    const double bx = static_cast<double>(b.x) - a.x, by = static_cast<double>(b.y) - a.y,
                 bz = static_cast<double>(b.z) - a.z;
    const double cx = static_cast<double>(c.x) - a.x, cy = static_cast<double>(c.y) - a.y,
                 cz = static_cast<double>(c.z) - a.z;
    const double area = bx * cy - by * cx;
    const double sx = (bz * cy - cz * by) / area, sy = (bx * cz - cx * bz) / area;
    WorstPoint worst{-1, kNoVertex};
    for (std::uint32_t q = first; q != kNoVertex; q = next_[q]) {
      const GridPoint& p = point(q);
      const double error = std::abs(static_cast<double>(p.z) - a.z - sx * (static_cast<double>(p.x) - a.x) -
                                    sy * (static_cast<double>(p.y) - a.y));
      if (error > worst.error || (error == worst.error && q < worst.point)) worst = {error, q};
    }
    return worst;
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
  TraitsPoint position(std::uint32_t v) const { return {point(v).x, point(v).y, v}; }
  const GridPoint& corner(CoarseFace f, int i) const { return point(f->vertex(i)->point().vertex); }

  void link(std::uint32_t v, CoarseFace f) {
    next_[v] = f->info().first;
    f->info().first = v;
  }

  static bool in_wedge(const StarFace& s, const TraitsPoint& centre, const TraitsPoint& p) {
    return orientation(centre, s.right, p) >= 0 && orientation(centre, s.left, p) <= 0;
  }

  std::uint32_t opposite(std::uint32_t triangle, std::uint32_t p, std::uint32_t q) const {
    if (triangle == kNoTriangle) return kNoVertex;
    const auto& [a, b, c] = fine_.mesh.triangles[triangle];
    return a != p && a != q ? a : b != p && b != q ? b : c;
  }

  const RegionMesh& fine_;
  VertexWalk walk_;
  std::vector<std::uint32_t> next_;      ///< by vertex: the next one in its face
  std::vector<std::uint32_t> homeless_;  ///< vertices of the faces that were taken
};

}  // namespace itin
