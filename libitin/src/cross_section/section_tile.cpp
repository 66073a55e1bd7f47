#include "cross_section/section_tile.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include <itin/box_of.hpp>

#include "geometry/predicates.hpp"

namespace itin {

SectionTile::SectionTile(const GridBox& square, const RegionMesh& region) : square_(square) {
  const auto count = static_cast<std::uint32_t>(region.mesh.triangles.size());
  vertices_.reserve(region.vertices.size());
  for (const SelectedVertex& v : region.vertices) vertices_.push_back({v.point, v.theme});
  std::vector<std::uint32_t> order(count), place(count);
  std::iota(order.begin(), order.end(), 0u);
  const auto least_corner = [&](std::uint32_t t) {
    return *std::min_element(region.mesh.triangles[t].begin(), region.mesh.triangles[t].end());
  };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return least_corner(a) < least_corner(b); });
  for (std::uint32_t i = 0; i < count; ++i) place[order[i]] = i;
  faces_.reserve(count);
  for (const std::uint32_t t : order) {
    Face face{region.mesh.triangles[t], region.mesh.neighbours[t]};
    for (std::uint32_t& n : face.neighbours) n = n == kNoTriangle ? kNoTriangle : place[n];
    faces_.push_back(face);
  }
  // Bins have about sixteen triangles: a line enters a tile once, and then goes on by neighbours.
  const double side = static_cast<double>(square.xmax) - square.xmin;
  bin_shift_ =
      std::min(31, static_cast<int>(std::bit_width(static_cast<std::uint64_t>(4 * side / std::sqrt(count + 1.0)))));
  columns_ = column(square.xmax) + 1, rows_ = row(square.ymax) + 1;
  bins_ = {std::size_t{columns_} * rows_, count,
           [&](std::uint32_t t, const auto& add) { for_each_bin(box_of(t), add); }};
}

std::size_t SectionTile::bytes() const {
  return sizeof(*this) + vertices_.capacity() * sizeof(SectionVertex) + faces_.capacity() * sizeof(Face) +
         bins_.bytes();
}

std::uint32_t SectionTile::column(std::int32_t x) const {
  return static_cast<std::uint32_t>(std::clamp(x, square_.xmin, square_.xmax) - square_.xmin) >> bin_shift_;
}

std::uint32_t SectionTile::row(std::int32_t y) const {
  return static_cast<std::uint32_t>(std::clamp(y, square_.ymin, square_.ymax) - square_.ymin) >> bin_shift_;
}

GridBox SectionTile::box_of(std::uint32_t triangle) const {
  return itin::box_of(std::array{corner(triangle, 0), corner(triangle, 1), corner(triangle, 2)});
}

template <typename Visit>
void SectionTile::for_each_bin(const GridBox& box, const Visit& visit) const {
  for (std::uint32_t r = row(box.ymin), last = row(box.ymax); r <= last; ++r) {
    for (std::uint32_t c = column(box.xmin), end = column(box.xmax); c <= end; ++c)
      visit(std::size_t{r} * columns_ + c);
  }
}

SectionTile::Stop SectionTile::ahead(const CrossedEdge& edge, Position place) const {
  for (const std::uint32_t t : bins_.in(std::size_t{row(place.y)} * columns_ + column(place.x))) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      if (same_position(corner(t, i), edge.left) && same_position(corner(t, (i + 1) % 3), edge.right))
        return {t, (i + 2) % 3};
    }
  }
  return {};
}

SectionTile::Stop SectionTile::onwards(const Stop& from, bool keeps_left) const {
  // The corners are counterclockwise: apex, left, right.
  const std::uint32_t next = faces_[from.triangle].neighbours[(from.apex + (keeps_left ? 2 : 1)) % 3];
  if (next == kNoTriangle) return {};
  const auto& back = faces_[next].neighbours;
  return {next, back[0] == from.triangle ? 0u : back[1] == from.triangle ? 1u : 2u};
}

std::vector<std::array<SectionVertex, 3>> SectionTile::around(const GridBox& box) const {
  std::vector<std::array<SectionVertex, 3>> result;
  for_each_bin(box, [&](std::size_t bin) {
    for (const std::uint32_t t : bins_.in(bin)) {
      if (box_of(t).meets(box)) result.push_back({corner(t, 0), corner(t, 1), corner(t, 2)});
    }
  });
  return result;
}

}  // namespace itin
