#include "topology/twin_half_edges.hpp"

#include <algorithm>

namespace itin {

namespace {

/// A half-edge that waits for its twin in the bucket of its lesser vertex.
struct Waiting {
  std::uint32_t greater_vertex;
  std::uint32_t half_edge;
};

}  // namespace

std::vector<std::uint32_t> twin_half_edges(const Tin& tin) {
  // Buckets hold a handful of half-edges, and vertices in curve order keep neighbouring buckets in cache: searching
  // them beats hashing and sorting.
  std::vector<std::uint32_t> first(tin.vertices.size() + 1, 0);
  for (const Triangle& t : tin.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++first[std::min(t[i], t[(i + 1) % 3]) + 1];
  }
  for (std::size_t v = 0; v + 1 < first.size(); ++v) first[v + 1] += first[v];

  std::vector<Waiting> waiting(first.back());
  std::vector<std::uint32_t> end(first.begin(), first.end() - 1);
  std::vector<std::uint32_t> twins(3 * tin.triangles.size(), kNoNeighbour);
  std::uint32_t half_edge = 0;
  for (const Triangle& t : tin.triangles) {
    for (std::size_t i = 0; i < 3; ++i, ++half_edge) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      const std::uint32_t lesser = std::min(a, b), greater = std::max(a, b);
      std::uint32_t w = first[lesser];
      while (w != end[lesser] && waiting[w].greater_vertex != greater) ++w;
      if (w == end[lesser]) {
        waiting[end[lesser]++] = {greater, half_edge};
      } else {
        twins[half_edge] = waiting[w].half_edge;
        twins[waiting[w].half_edge] = half_edge;
        waiting[w] = waiting[--end[lesser]];
      }
    }
  }
  return twins;
}

std::vector<std::array<std::uint32_t, 3>> adjacent_triangles(const Tin& tin) {
  const std::vector<std::uint32_t> twins = twin_half_edges(tin);
  std::vector<std::array<std::uint32_t, 3>> adjacent(tin.triangles.size());
  for (std::size_t h = 0; h < twins.size(); ++h)
    adjacent[h / 3][h % 3] = twins[h] == kNoNeighbour ? kNoNeighbour : Topology::face(twins[h]);
  return adjacent;
}

}  // namespace itin
