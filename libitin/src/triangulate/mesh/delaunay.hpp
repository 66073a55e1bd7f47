// Bulk constrained Delaunay triangulation of grid positions, by CGAL on exact integer predicates.
//
//   Delaunay delaunay;
//   delaunay.insert(positions);                       // vertex numbers follow the order of insertion, from 0 or from
//                                                     // after the greatest one so far
//   delaunay.constrain({{0, 17}, {17, 40}});
//   PlaneMesh mesh = delaunay.mesh();
//
// Cocircular ties are broken by the rule of predicates.hpp, so the result depends on the set of positions and
// constraints alone. Constraints may meet only at vertices; one that passes through vertices is split by them.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "geometry/predicates.hpp"

namespace itin {

inline constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();

/// Triangles with their neighbours. Corner i of a triangle is opposite its neighbour i and its edge i.
struct PlaneMesh {
  std::vector<std::array<std::uint32_t, 3>> triangles;   ///< vertex numbers, counterclockwise
  std::vector<std::array<std::uint32_t, 3>> neighbours;  ///< kNoTriangle beyond the hull
  std::vector<std::uint8_t> constrained;                 ///< bit i: edge i is part of a constraint (region.hpp)
  static constexpr int kOutline = 3;                     ///< bit i + kOutline: edge i is part of the coverage outline
};

class Delaunay {
 public:
  using Constraint = std::pair<std::uint32_t, std::uint32_t>;

  Delaunay();
  Delaunay(Delaunay&&) noexcept;
  Delaunay& operator=(Delaunay&&) noexcept;
  ~Delaunay();

  /// Inserts positions. All positions ever inserted must differ. Fastest when they come along a space-filling curve:
  /// about 2.8 million per second.
  void insert(std::span<const Position> positions);
  /// Inserts positions under these numbers, one each.
  void insert(std::span<const Position> positions, std::span<const std::uint32_t> numbers);
  /// Inserts constraints between the numbers of inserted vertices. Precondition: their ends differ.
  void constrain(std::span<const Constraint> constraints);
  /// Returns the mesh, which is empty while all vertices are collinear.
  PlaneMesh mesh() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace itin
