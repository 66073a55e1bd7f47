#include "void_shadow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <viewshed/certified.hpp>

namespace itin::viewshed {

namespace {

constexpr std::size_t kSectors = 4096;

}  // namespace

VoidShadow::VoidShadow(const Tin& tin, const std::vector<BoundaryEdge>& boundary, const Point3& eye)
    : tin_(tin), eye_(eye) {
  for (const BoundaryEdge& edge : boundary) {
    const GridPoint &a = tin.vertices[edge.from], &b = tin.vertices[edge.to];
    // The surface lies to the left: seen from its right side it begins here.
    const double side = (double{1} * b.x - a.x) * (eye.y - a.y) - (double{1} * b.y - a.y) * (eye.x - a.x);
    if (side >= 0) continue;
    sectors_.resize(kSectors);
    // From the right side an edge runs clockwise; a sector more on both sides, against rounding.
    const std::size_t last = (sector_of(b.x, b.y) + 1) % kSectors;
    for (std::size_t s = (sector_of(a.x, a.y) + kSectors - 1) % kSectors;; s = (s + 1) % kSectors) {
      sectors_[s].push_back(edge);
      if (s == last) break;
    }
  }
}

bool VoidShadow::holds(double x, double y) const {
  if (sectors_.empty()) return false;
  const std::vector<BoundaryEdge>& edges = sectors_[sector_of(x, y)];
  SightLines line;
  line.from_x[0] = eye_.x, line.from_y[0] = eye_.y;
  line.to_x[0] = x, line.to_y[0] = y;
  return std::any_of(edges.begin(), edges.end(),
                     [&](const BoundaryEdge& edge) { return crossing_back(tin_, edge, line, 0) == Crossing::kBack; });
}

void VoidShadow::hide(const TileCentres& centres, TileValues<std::uint8_t>& values) const {
  if (sectors_.empty()) return;
  for (std::size_t cell = 0; cell < values.size(); ++cell) {
    if (values[cell] == kCertainlyVisible && holds(centres.x[cell % Tile::kSide], centres.y[cell / Tile::kSide]))
      values[cell] = kCertainlyHidden;
  }
}

std::size_t VoidShadow::sector_of(double x, double y) const {
  const double turns = std::atan2(x - eye_.x, y - eye_.y) / (2 * std::numbers::pi) + 0.5;
  return std::min(kSectors - 1, static_cast<std::size_t>(turns * kSectors));
}

}  // namespace itin::viewshed
