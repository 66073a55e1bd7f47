#include "triangulate/mesh/mesh_order.hpp"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace itin {

namespace {

/// Returns the corner of a triangle that is its least vertex.
unsigned least_corner(const std::array<std::uint32_t, 3>& t) {
  if (t[0] < t[1]) return t[0] < t[2] ? 0 : 2;
  return t[1] < t[2] ? 1 : 2;
}

struct Turned {
  std::uint32_t second, triangle;
  unsigned least;
};

/// Distributes triangles by their first vertex; those of one vertex, two on average, are sorted by the second one.
std::vector<Turned> ascending(const std::vector<std::array<std::uint32_t, 3>>& triangles, std::size_t vertex_count) {
  std::vector<std::uint32_t> place(vertex_count + 1, 0);
  for (const auto& t : triangles) ++place[t[least_corner(t)] + 1];
  for (std::size_t v = 0; v < vertex_count; ++v) place[v + 1] += place[v];
  std::vector<Turned> order(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const unsigned least = least_corner(triangles[t]);
    order[place[triangles[t][least]]++] = {triangles[t][(least + 1) % 3], t, least};
  }
  // By now each place is where the next vertex's triangles begin. A call of std::sort takes longer than sorting two.
  for (std::size_t v = 0, begin = 0; v < vertex_count; begin = place[v++]) {
    for (std::size_t i = begin + 1; i < place[v]; ++i)
      for (std::size_t k = i; k > begin && order[k].second < order[k - 1].second; --k)
        std::swap(order[k], order[k - 1]);
  }
  return order;
}

}  // namespace

PlaneMesh in_order(const PlaneMesh& mesh, std::size_t vertex_count) {
  const std::vector<Turned> order = ascending(mesh.triangles, vertex_count);
  std::vector<std::uint32_t> number(order.size());
  for (std::uint32_t n = 0; n < order.size(); ++n) number[order[n].triangle] = n;
  PlaneMesh result{std::vector<std::array<std::uint32_t, 3>>(order.size()),
                   std::vector<std::array<std::uint32_t, 3>>(order.size()), std::vector<std::uint8_t>(order.size())};
  for (std::size_t n = 0; n < order.size(); ++n) {
    const std::uint32_t t = order[n].triangle;
    unsigned constrained = 0;
    for (unsigned i = 0; i < 3; ++i) {
      const unsigned from = (i + order[n].least) % 3;
      const std::uint32_t neighbour = mesh.neighbours[t][from];
      result.triangles[n][i] = mesh.triangles[t][from];
      result.neighbours[n][i] = neighbour == kNoTriangle ? kNoTriangle : number[neighbour];
      constrained |= (mesh.constrained[t] >> from & 1U) << i;
      constrained |= (mesh.constrained[t] >> (from + PlaneMesh::kOutline) & 1U) << (i + PlaneMesh::kOutline);
    }
    result.constrained[n] = static_cast<std::uint8_t>(constrained);
  }
  return result;
}

}  // namespace itin
