#include "pyramid/coverage/ground_edges.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "pyramid/points/source_index.hpp"

namespace itin {

namespace {

class EdgeList {
 public:
  EdgeList(std::span<const SelectedVertex> vertices, const GridBox& box) : vertices_(vertices), box_(box) {
    found_.touched.assign(vertices.size(), 0);
  }

  void touch(std::uint32_t v) { found_.touched[v] = 1; }
  /// All triangles at a vertex in the box are known, and so are its edges; farther away some neighbours are missing.
  void add(std::uint32_t from, std::uint32_t to) {
    const GridPoint &a = vertices_[from].point, &b = vertices_[to].point;
    if (box_.contains(a.x, a.y) || box_.contains(b.x, b.y))
      found_.edges.push_back({{a.x, a.y, b.x, b.y}, std::min(code_of(a), code_of(b))});
  }
  GroundEdges take() { return std::move(found_); }

 private:
  std::span<const SelectedVertex> vertices_;
  GridBox box_;
  GroundEdges found_;
};

/// The ground among posts of a lattice. Three posts of a square make one triangle, and four make two, for no other
/// point lies in the circle about the square.
class LatticeSurvey {
 public:
  LatticeSurvey(std::span<const SelectedVertex> vertices, const LatticePosts& posts, const GridBox& box)
      : posts_(posts), edges_(vertices, box) {}

  GroundEdges run() {
    for (std::int64_t row = 0; row < posts_.rows(); ++row) {
      for (std::int64_t column = 0; column < posts_.columns(); ++column) {
        add_edges_of_square(column, row);
        add_edges_of_sides(column, row);
      }
    }
    return edges_.take();
  }

 private:
  /// The square's posts from the lower left one on, counterclockwise; kNoVertex where there is no post.
  std::array<std::uint32_t, 4> square(std::int64_t column, std::int64_t row) const {
    return {posts_.vertex({column, row}), posts_.vertex({column + 1, row}), posts_.vertex({column + 1, row + 1}),
            posts_.vertex({column, row + 1})};
  }
  static bool is_ground(const std::array<std::uint32_t, 4>& corners) {
    return std::count(corners.begin(), corners.end(), kNoVertex) <= 1;
  }

  /// With one post missing, ground ends between its neighbours.
  void add_edges_of_square(std::int64_t column, std::int64_t row) {
    const std::array<std::uint32_t, 4> corners = square(column, row);
    if (!is_ground(corners)) return;
    for (std::size_t i = 0; i < 4; ++i) {
      if (corners[i] != kNoVertex)
        edges_.touch(corners[i]);
      else
        edges_.add(corners[(i + 3) % 4], corners[(i + 1) % 4]);
    }
  }

  /// Ground ends along the side to the east, or to the north, of this post, if it lies on one side only.
  void add_edges_of_sides(std::int64_t column, std::int64_t row) {
    const std::uint32_t own = posts_.vertex({column, row}), east = posts_.vertex({column + 1, row}),
                        north = posts_.vertex({column, row + 1});
    if (own == kNoVertex) return;
    const bool ground = is_ground(square(column, row));
    if (east != kNoVertex) add_edge_of_side(own, east, ground, is_ground(square(column, row - 1)));
    if (north != kNoVertex) add_edge_of_side(own, north, is_ground(square(column - 1, row)), ground);
  }

  void add_edge_of_side(std::uint32_t from, std::uint32_t to, bool left, bool right) {
    if (left && !right) edges_.add(from, to);
    if (right && !left) edges_.add(to, from);
  }

  const LatticePosts& posts_;
  EdgeList edges_;
};

}  // namespace

GroundEdges ground_edges(const RegionMesh& surface, const GapRule& gaps, const GridBox& box) {
  const auto& triangles = surface.mesh.triangles;
  std::vector<std::uint8_t> ground;
  for (const auto& [a, b, c] : triangles)
    ground.push_back(gaps.ground(surface.vertices[a], surface.vertices[b], surface.vertices[c]));
  EdgeList edges(surface.vertices, box);
  for (std::size_t t = 0; t < ground.size(); ++t) {
    if (!ground[t]) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      edges.touch(triangles[t][i]);
      const std::uint32_t n = surface.mesh.neighbours[t][i];
      if (n == kNoTriangle || !ground[n]) edges.add(triangles[t][(i + 1) % 3], triangles[t][(i + 2) % 3]);
    }
  }
  return edges.take();
}

std::optional<GroundEdges> ground_edges(std::span<const SelectedVertex> vertices, const LatticePosts& posts,
                                        const GapRule& gaps, const GridBox& box) {
  const Sources sources = sources_of(vertices);
  const auto x = static_cast<double>(posts.step_x()), y = static_cast<double>(posts.step_y());
  const bool squares_alone = std::all_of(
      sources.begin(), sources.end(), [&](std::uint16_t source) { return gaps.bridges_squares_alone(source, x, y); });
  if (!squares_alone) return std::nullopt;
  return LatticeSurvey(vertices, posts, box).run();
}

}  // namespace itin
