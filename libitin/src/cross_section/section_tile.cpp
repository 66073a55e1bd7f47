#include "cross_section/section_tile.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace itin {

namespace {

bool same_place(const GridPoint& a, const GridPoint& b) {
  return a.x == b.x && a.y == b.y;
}

}  // namespace

SectionTile::SectionTile(const GridBox& square, RegionMesh region) : square_(square), region_(std::move(region)) {
  const auto count = static_cast<std::uint32_t>(region_.mesh.triangles.size());
  region_.mesh.constrained = {};
  region_.vertices.shrink_to_fit();
  // Bins of about one triangle.
  const double side = static_cast<double>(square.xmax) - square.xmin;
  bin_shift_ = std::bit_width(static_cast<std::uint32_t>(side / std::sqrt(count + 1.0)));
  columns_ = column(square.xmax) + 1, rows_ = row(square.ymax) + 1;
  first_.assign(std::size_t{columns_} * rows_ + 1, 0);
  for (std::uint32_t t = 0; t < count; ++t) for_each_bin(box_of(t), [&](std::size_t bin) { ++first_[bin + 1]; });
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  triangles_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t t = 0; t < count; ++t) {
    for_each_bin(box_of(t), [&](std::size_t bin) { triangles_[next[bin]++] = t; });
  }
}

std::size_t SectionTile::bytes() const {
  return sizeof(*this) + region_.vertices.size() * sizeof(SelectedVertex) +
         region_.mesh.triangles.size() * 2 * sizeof(Triangle) +
         (first_.size() + triangles_.size()) * sizeof(std::uint32_t);
}

std::uint32_t SectionTile::column(std::int32_t x) const {
  return static_cast<std::uint32_t>(std::clamp(x, square_.xmin, square_.xmax) - square_.xmin) >> bin_shift_;
}

std::uint32_t SectionTile::row(std::int32_t y) const {
  return static_cast<std::uint32_t>(std::clamp(y, square_.ymin, square_.ymax) - square_.ymin) >> bin_shift_;
}

GridBox SectionTile::box_of(std::uint32_t triangle) const {
  GridBox box;
  for (std::size_t i = 0; i < 3; ++i) box.extend(corner(triangle, i).x, corner(triangle, i).y);
  return box;
}

template <typename Visit>
void SectionTile::for_each_bin(const GridBox& box, const Visit& visit) const {
  for (std::uint32_t r = row(box.ymin), last = row(box.ymax); r <= last; ++r) {
    for (std::uint32_t c = column(box.xmin), end = column(box.xmax); c <= end; ++c)
      visit(std::size_t{r} * columns_ + c);
  }
}

std::span<const std::uint32_t> SectionTile::in_bin(std::size_t bin) const {
  return {triangles_.data() + first_[bin], first_[bin + 1] - first_[bin]};
}

std::uint32_t SectionTile::triangle_ahead(const CrossedEdge& edge, Position place) const {
  for (const std::uint32_t t : in_bin(std::size_t{row(place.y)} * columns_ + column(place.x))) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (same_place(corner(t, i), edge.left) && same_place(corner(t, (i + 1) % 3), edge.right)) return t;
    }
  }
  return kNoTriangle;
}

std::size_t SectionTile::corner_off(std::uint32_t triangle, const CrossedEdge& edge) const {
  std::size_t i = 0;
  while (same_place(corner(triangle, i), edge.left) || same_place(corner(triangle, i), edge.right)) ++i;
  return i;
}

std::uint32_t SectionTile::neighbour(std::uint32_t triangle, const CrossedEdge& edge) const {
  return region_.mesh.neighbours[triangle][corner_off(triangle, edge)];
}

const GridPoint& SectionTile::apex(std::uint32_t triangle, const CrossedEdge& edge) const {
  return corner(triangle, corner_off(triangle, edge));
}

std::vector<std::array<GridPoint, 3>> SectionTile::around(const GridBox& box) const {
  std::vector<std::array<GridPoint, 3>> result;
  for_each_bin(box, [&](std::size_t bin) {
    for (const std::uint32_t t : in_bin(bin)) {
      if (box_of(t).meets(box)) result.push_back({corner(t, 0), corner(t, 1), corner(t, 2)});
    }
  });
  return result;
}

}  // namespace itin
