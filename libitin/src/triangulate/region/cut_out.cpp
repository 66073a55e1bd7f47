#include "triangulate/region/cut_out.hpp"

#include <algorithm>

#include "triangulate/mesh/mesh_order.hpp"

namespace itin {

namespace {

/// Gives the vertices of the kept triangles new numbers in Morton order, and puts these vertices out.
std::vector<std::uint32_t> number_vertices(const PlaneMesh& mesh, std::span<const std::uint32_t> kept,
                                           std::span<const SelectedVertex> vertices, std::uint32_t in_order,
                                           std::vector<SelectedVertex>& out) {
  std::vector<std::uint8_t> used(vertices.size(), 0);
  for (const std::uint32_t t : kept) {
    for (const std::uint32_t v : mesh.triangles[t]) used[v] = 1;
  }
  std::vector<std::uint32_t> order;
  std::ptrdiff_t middle = 0;
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    if (used[v] == 0) continue;
    order.push_back(v);
    if (v < in_order) ++middle;
  }
  const auto less = [&](std::uint32_t a, std::uint32_t b) { return code_of(vertices[a]) < code_of(vertices[b]); };
  std::sort(order.begin() + middle, order.end(), less);
  std::inplace_merge(order.begin(), order.begin() + middle, order.end(), less);
  std::vector<std::uint32_t> number(vertices.size(), kNoTriangle);
  out.reserve(order.size());
  for (const std::uint32_t v : order) {
    number[v] = static_cast<std::uint32_t>(out.size());
    out.push_back(vertices[v]);
  }
  return number;
}

}  // namespace

RegionMesh cut_out(const PlaneMesh& mesh, std::span<const std::uint32_t> kept, std::span<const SegmentEdge> edges,
                   std::span<const SelectedVertex> vertices, std::uint32_t in_order) {
  RegionMesh result;
  const std::vector<std::uint32_t> vertex_number = number_vertices(mesh, kept, vertices, in_order, result.vertices);
  std::vector<std::uint32_t> triangle_number(mesh.triangles.size(), kNoTriangle);
  for (std::uint32_t k = 0; k < kept.size(); ++k) triangle_number[kept[k]] = k;
  const auto number = [&](std::uint32_t t) { return t == kNoTriangle ? kNoTriangle : triangle_number[t]; };
  for (const std::uint32_t t : kept) {
    Triangle triangle{}, neighbours{};
    for (int i = 0; i < 3; ++i) {
      triangle[i] = vertex_number[mesh.triangles[t][i]];
      neighbours[i] = number(mesh.neighbours[t][i]);
    }
    result.mesh.triangles.push_back(triangle);
    result.mesh.neighbours.push_back(neighbours);
    result.mesh.constrained.push_back(mesh.constrained[t]);
  }
  for (const SegmentEdge& edge : edges) {
    if (edge.theme == kCoverage || (number(edge.left) == kNoTriangle && number(edge.right) == kNoTriangle)) continue;
    const auto [from, to] = std::minmax({vertex_number[edge.from], vertex_number[edge.to]});
    result.lines.push_back({from, to, edge.theme});
  }
  result.mesh = itin::in_order(result.mesh, result.vertices.size());
  return result;
}

}  // namespace itin
