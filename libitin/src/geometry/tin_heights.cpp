#include <itin/grid_units.hpp>
#include <itin/tin_heights.hpp>

namespace itin {

std::optional<double> height_over(const std::array<GridPoint, 3>& triangle, Point2 units) {
  const auto& [x, y] = units;
  const RowSections sections(triangle);
  if (y < sections.lowest() || y > sections.highest()) return std::nullopt;
  const auto [west, east] = sections.at(y);
  if (x < west.x || x > east.x) return std::nullopt;
  return RowSections::height(west, east, x);
}

std::optional<double> height_over(const Tin& tin, std::span<const std::uint32_t> triangles, Point2 units) {
  for (const std::uint32_t t : triangles)
    if (const auto height = height_over(tin.corners(t), units)) return height;
  return std::nullopt;
}

std::optional<double> height_on(const Tin& tin, Point2 position) {
  const Point2 units = place_in_units(tin.grid, position);
  const auto beside = [&](const std::array<GridPoint, 3>& corners) {
    const auto& [a, b, c] = corners;
    return (a.x < units.x && b.x < units.x && c.x < units.x) || (a.x > units.x && b.x > units.x && c.x > units.x);
  };
  for (std::uint32_t i = 0; i < tin.triangles.size(); ++i) {
    if (beside(tin.corners(i))) continue;
    if (const auto height = height_over(tin.corners(i), units)) return *height * tin.grid.resolution;
  }
  return std::nullopt;
}

}  // namespace itin
