#include "pyramid/greedy/greedy.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <itin/convex_hull.hpp>

#include "pyramid/greedy/greedy_insertion.hpp"
#include "pyramid/greedy/lattice_ground.hpp"
#include "pyramid/greedy/mesh_ground.hpp"

namespace itin {

namespace {

std::vector<std::uint32_t> hull_of(std::span<const SelectedVertex> vertices, std::vector<std::uint32_t> candidates) {
  if (candidates.empty()) return candidates;
  const auto at = [&](std::uint32_t v) { return vertices[v].position(); };
  // No vertex within the outermost ones along both diagonals is on the hull (Akl and Toussaint 1978); this covers most
  // of a raster.
  const auto sum = [&](std::uint32_t v) { return std::int64_t{at(v).x} + at(v).y; };
  const auto difference = [&](std::uint32_t v) { return std::int64_t{at(v).x} - at(v).y; };
  const auto by = [](const auto& key) { return [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); }; };
  const auto [south_west, north_east] = std::minmax_element(candidates.begin(), candidates.end(), by(sum));
  const auto [north_west, south_east] = std::minmax_element(candidates.begin(), candidates.end(), by(difference));
  const std::array<Position, 4> outermost{at(*south_west), at(*south_east), at(*north_east), at(*north_west)};
  std::erase_if(candidates, [&](std::uint32_t v) {
    for (std::size_t i = 0; i < 4; ++i)
      if (orientation(outermost[i], outermost[(i + 1) % 4], at(v)) <= 0) return false;
    return true;
  });
  return convex_hull(
      std::move(candidates), [&](std::uint32_t a, std::uint32_t b) { return at(a) < at(b); },
      [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) { return orientation(at(a), at(b), at(c)) > 0; });
}

template <class Ground>
std::vector<std::uint8_t> levels_over(Ground& ground, std::span<const Candidacy> candidacy,
                                      std::span<const double> tolerances, std::size_t finest) {
  const std::vector<SelectedVertex>& vertices = ground.vertices();
  const std::size_t coarsest = tolerances.size() - 1;
  std::vector<std::uint8_t> levels(candidacy.size(), 0);
  std::vector<std::uint32_t> candidates;
  std::vector<std::vector<std::uint32_t>> given(tolerances.size());
  for (std::uint32_t v = 0; v < candidacy.size(); ++v) {
    if (candidacy[v] == Candidacy::kNone) continue;
    candidates.push_back(v);
    levels[v] = candidacy[v] == Candidacy::kCorner ? static_cast<std::uint8_t>(coarsest) : vertices[v].level;
    if (levels[v] > 0) given[levels[v]].push_back(v);
  }
  std::vector<std::uint32_t> first = hull_of(vertices, std::move(candidates));
  first.insert(first.end(), given[coarsest].begin(), given[coarsest].end());
  for (const std::uint32_t v : first) levels[v] = static_cast<std::uint8_t>(coarsest);
  GreedyInsertion<Ground> greedy(ground, candidacy, tolerances);
  if (!greedy.start(std::move(first))) return levels;
  for (std::size_t k = coarsest; k >= finest; --k) {
    greedy.begin_level(k);
    greedy.insert_given(given[k]);
    greedy.refine([&](std::uint32_t v) { levels[v] = static_cast<std::uint8_t>(k); });
  }
  return levels;
}

}  // namespace

std::vector<std::uint8_t> greedy_levels(const RegionMesh& fine, std::span<const Candidacy> candidacy,
                                        std::span<const double> tolerances, std::size_t finest) {
  MeshGround ground(fine, candidacy);
  return levels_over(ground, candidacy, tolerances, finest);
}

std::vector<std::uint8_t> greedy_levels(const std::vector<SelectedVertex>& vertices, const LatticePosts& posts,
                                        std::span<const Candidacy> candidacy, std::span<const double> tolerances,
                                        std::size_t finest) {
  LatticeGround ground(vertices, posts, candidacy);
  return levels_over(ground, candidacy, tolerances, finest);
}

}  // namespace itin
