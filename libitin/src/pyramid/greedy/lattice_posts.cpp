#include "pyramid/greedy/lattice_posts.hpp"

#include <algorithm>

#include <itin/box_of.hpp>

#include "geometry/post_lattice.hpp"

namespace itin {

namespace {

/// The least share of places that have a post. Far fewer would cost memory, and rows that are walked in vain.
constexpr double kLeastShare = 1.0 / 16;
/// The least share of posts with neighbours to the east and north.
constexpr double kLeastWithNeighbours = 0.5;

}  // namespace

std::optional<LatticePosts> LatticePosts::of(std::span<const SelectedVertex> vertices) {
  LatticePosts posts;
  if (!posts.find_lattice(vertices)) return std::nullopt;
  posts.place(vertices);
  // In a single row no post has a neighbour to the north.
  const bool in_line = posts.columns_ == 1 || posts.rows_ == 1;
  const double wanted = kLeastWithNeighbours * static_cast<double>(vertices.size());
  if (!in_line && static_cast<double>(posts.count_with_neighbours()) < wanted) return std::nullopt;
  return posts;
}

/// Finds the lattice, and tells whether it is full enough.
bool LatticePosts::find_lattice(std::span<const SelectedVertex> vertices) {
  const GridBox box = box_of(vertices, &SelectedVertex::point);
  if (box.empty()) return false;
  west_ = box.xmin, south_ = box.ymin;
  WidestLattice widest;
  for (const SelectedVertex& v : vertices) widest.add(v.point.x, v.point.y);
  step_x_ = widest.lattice().step_x, step_y_ = widest.lattice().step_y;
  constexpr double kMoreThanOne = 1 + 1e-12;
  columns_per_unit_ = kMoreThanOne / static_cast<double>(step_x_);
  rows_per_unit_ = kMoreThanOne / static_cast<double>(step_y_);
  columns_ = (std::int64_t{box.xmax} - west_) / step_x_ + 1, rows_ = (std::int64_t{box.ymax} - south_) / step_y_ + 1;
  return static_cast<double>(vertices.size()) >=
         kLeastShare * static_cast<double>(columns_) * static_cast<double>(rows_);
}

void LatticePosts::place(std::span<const SelectedVertex> vertices) {
  vertices_.assign(places(), kNoVertex);
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    const LatticePlace place = place_of(vertices[v].point);
    vertices_[index(place.column, place.row)] = v;
  }
}

/// Counts the posts with neighbours to the east and north.
std::size_t LatticePosts::count_with_neighbours() const {
  std::size_t count = 0;
  for (std::int64_t row = 0; row + 1 < rows_; ++row) {
    for (std::int64_t column = 0; column + 1 < columns_; ++column)
      count += has(column, row) && has(column + 1, row) && has(column, row + 1);
  }
  return count;
}

}  // namespace itin
