#include "features/mesh/eaves_abreast.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <itin/sort_unique.hpp>

namespace itin {

namespace {

/// The longest way across, in offsets. Beside acuter corners of the outline the eaves are further away, and bend so
/// much that nothing runs straight along both of their lines.
constexpr double kFurthest = 1.5;

/// The position on a line of eaves that is nearest to a place, rounded to the grid.
struct Nearest {
  double squared_distance = std::numeric_limits<double>::infinity();
  GridPoint at;
  double along = 0;  ///< 0 at the line's beginning, 1 at its end
  std::size_t line = 0;
};

Nearest nearest_on(const RoofLine& line, Position place) {
  const double dx = double{1} * line.b.x - line.a.x, dy = double{1} * line.b.y - line.a.y;
  const double x = double{1} * place.x - line.a.x, y = double{1} * place.y - line.a.y;
  Nearest result;
  result.along = std::clamp((x * dx + y * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  const double u = result.along * dx, v = result.along * dy, w = result.along * (double{1} * line.b.z - line.a.z);
  result.squared_distance = (x - u) * (x - u) + (y - v) * (y - v);
  const auto moved = [](std::int32_t from, double by) { return from + static_cast<std::int32_t>(std::lround(by)); };
  result.at = {moved(line.a.x, u), moved(line.a.y, v), moved(line.a.z, w)};
  return result;
}

struct Way {
  Position place;
  Nearest end;
};

/// Compares distances, then positions. Where two lines end at the nearest position, either will do.
bool nearer(const Nearest& a, const Nearest& b) {
  return std::tie(a.squared_distance, a.at) < std::tie(b.squared_distance, b.at);
}

std::vector<Way> ways(const std::vector<RoofLine>& lines, std::vector<Position> places, double offset) {
  sort_unique(places);
  std::vector<Way> result;
  for (const Position& p : places) result.push_back({p, {}});
  const double furthest = kFurthest * offset + 1;
  const auto reach = static_cast<std::int32_t>(std::ceil(furthest));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!lines[i].eaves) continue;
    const auto [west, east] = std::minmax(lines[i].a.x, lines[i].b.x);
    const auto begins = [](const Way& way, std::int32_t x) { return way.place.x < x; };
    auto way = std::lower_bound(result.begin(), result.end(), west - reach, begins);
    for (; way != result.end() && way->place.x <= east + reach; ++way) {
      Nearest offered = nearest_on(lines[i], way->place);
      offered.line = i;
      if (nearer(offered, way->end)) way->end = offered;
    }
  }
  std::erase_if(result, [&](const Way& way) { return way.end.squared_distance > furthest * furthest; });
  return result;
}

}  // namespace

std::vector<WayAcross> ways_across(const std::vector<RoofLine>& lines, std::vector<Position> places, double offset) {
  std::vector<WayAcross> result;
  for (const Way& way : ways(lines, std::move(places), offset)) result.push_back({way.place, way.end.at});
  return result;
}

void split_abreast(std::vector<RoofLine>& lines, std::vector<Position> places, double offset) {
  std::vector<Way> found = ways(lines, std::move(places), offset);
  std::sort(found.begin(), found.end(), [](const Way& a, const Way& b) {
    return std::tie(a.end.line, a.end.along) < std::tie(b.end.line, b.end.along);
  });
  for (const Way& way : found) {
    // The rest of a cut line keeps the line's index.
    RoofLine& rest = lines[way.end.line];
    const GridPoint& vertex = way.end.at;
    if (same_position(rest.a, vertex) || same_position(rest.b, vertex)) continue;
    const RoofLine before{rest.a, vertex, true};
    rest.a = vertex;
    lines.push_back(before);
  }
}

}  // namespace itin
