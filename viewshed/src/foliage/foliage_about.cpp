#include "foliage/foliage_about.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include <itin/clearance.hpp>
#include <itin/grazing.hpp>
#include <itin/parallel.hpp>
#include <itin/section_themes.hpp>
#include <itin/segment_distance.hpp>

#include "line/infinity.hpp"
#include "line/rounded_outwards.hpp"

namespace itin::viewshed {

namespace {

constexpr double kWholeTurn = 2 * std::numbers::pi;

/// Angles are computed to far less than this many radians.
constexpr double kAngleError = 1e-9;

/// A line that passes both ends of an edge within this many grid units runs along it.
constexpr double kAlongEdge = 1e-3;

/// In about how many directions a triangle lies, so that lists stay short and yet fit their lines.
constexpr double kDirectionsOfTriangle = 3;
constexpr double kMostDirections = 1 << 16;

/// How many triangles of a direction have one bound on their height.
constexpr std::size_t kFew = 16;

/// Bounds the slope at which anything that high above the eye appears, between two distances.
double slope_bound(double above, double nearest, double farthest, double drop) {
  if (above >= 0 && nearest == 0) return kInfinity;
  return (above >= 0 ? above / nearest : above / farthest) - drop * nearest;
}

}  // namespace

struct FoliageAbout::Line {
  Line(const Point3& eye, const Point3& target, double drop)
      : dx(target.x - eye.x),
        dy(target.y - eye.y),
        squared(dx * dx + dy * dy),
        per_squared(1 / squared),
        length(std::sqrt(squared)),
        slope((target.z - eye.z) / length - drop * length),
        over(eye.z, target.z, 1, drop * squared) {}

  double dx, dy, squared, per_squared, length;
  double slope;  ///< at which the target appears
  LineOverGround over;
};

struct FoliageAbout::Crossing {
  GroundPoint at;
  std::uint16_t theme = 0;
};

/// On which sides of a line a triangle's corners are. A corner on the line counts as left of it, seen from the end that
/// SectionLine starts at.
struct FoliageAbout::Sides {
  std::array<double, 3> side{};  ///< in proportion to the distance; 0 on the line
  std::array<bool, 3> left{};

  /// Returns the corners of the edge on the line, if there is one.
  std::optional<std::pair<std::size_t, std::size_t>> edge_on_line() const {
    for (std::size_t i = 0; i < 3; ++i)
      if (side[i] == 0 && side[(i + 1) % 3] == 0) return std::pair(i, (i + 1) % 3);
    return std::nullopt;
  }
};

FoliageAbout::FoliageAbout(const Tin& surface, const std::vector<bool>& vegetation, const Point3& eye,
                           const Earth& earth)
    : surface_(surface),
      vegetation_(vegetation),
      eye_(eye),
      drop_(earth.drop_coefficient() * surface.grid.resolution),
      grazing_(kGrazing / surface.grid.resolution) {
  if (surface.raised_theme.empty()) return;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
    if (is_foliage(surface.triangles[t])) entries_.push_back({.triangle = t});
  constexpr std::size_t kChunk = 4096;
  parallel_for((entries_.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    for (std::size_t i = chunk * kChunk; i < std::min(entries_.size(), (chunk + 1) * kChunk); ++i)
      entries_[i] = entry_of(entries_[i].triangle);
  });
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return std::pair(a.nearest, a.triangle) < std::pair(b.nearest, b.triangle);
  });
  list_by_direction();
}

void FoliageAbout::list_by_direction() {
  double widths = kAngleError;
  for (const Entry& entry : entries_) widths += entry.width;
  directions_ = static_cast<std::size_t>(std::clamp(
      kDirectionsOfTriangle * kWholeTurn * static_cast<double>(entries_.size()) / widths, 1.0, kMostDirections));
  by_direction_ = {directions_, entries_.size(), [&](std::uint32_t i, const auto& add) {
                     const Entry& entry = entries_[i];
                     if (entry.width >= kWholeTurn) {
                       for (std::size_t d = 0; d < directions_; ++d) add(d);
                       return;
                     }
                     const std::size_t last = direction_of(entry.from + entry.width);
                     for (std::size_t d = direction_of(entry.from);; d = (d + 1) % directions_) {
                       add(d);
                       if (d == last) return;
                     }
                   }};
  for (std::size_t d = 0; d < directions_; ++d) {
    first_few_.push_back(highest_.size());
    const auto list = by_direction_.in(d);
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (i % kFew == 0) highest_.push_back(-kFloatInfinity);
      highest_.back() = std::max(highest_.back(), entries_[list[i]].highest);
    }
  }
}

bool FoliageAbout::is_foliage(const Triangle& triangle) const {
  return std::any_of(triangle.begin(), triangle.end(), [&](std::uint32_t v) {
    const std::uint16_t theme = surface_.raised_theme[v];
    return theme < vegetation_.size() && vegetation_[theme];
  });
}

FoliageAbout::Entry FoliageAbout::entry_of(std::uint32_t triangle) const {
  const std::array<GridPoint, 3> corners = surface_.corners(triangle);
  std::array<Point2, 3> at;
  double highest = -kInfinity, farthest = 0, nearest = kInfinity;
  for (std::size_t i = 0; i < 3; ++i) {
    at[i] = {corners[i].x - eye_.x, corners[i].y - eye_.y};
    highest = std::max(highest, corners[i].z - eye_.z);
    farthest = std::max(farthest, std::hypot(at[i].x, at[i].y));
  }
  bool about_eye = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point2 &a = at[i], &b = at[(i + 1) % 3];
    const Point2 way = way_from_segment({0, 0}, a, b);
    nearest = std::min(nearest, way.x * way.x + way.y * way.y);
    about_eye = about_eye && a.x * b.y - a.y * b.x >= 0;
  }
  // So near to the eye, angles are matters of rounding.
  nearest = about_eye || nearest < 1 ? 0 : std::sqrt(nearest);
  Entry entry{0, kWholeTurn, rounded_down(nearest), rounded_up(slope_bound(highest, nearest, farthest, drop_)),
              triangle};
  if (nearest == 0) return entry;
  const double first = std::atan2(at[0].y, at[0].x);
  double low = 0, high = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    const double turn = std::remainder(std::atan2(at[i].y, at[i].x) - first, kWholeTurn);
    low = std::min(low, turn), high = std::max(high, turn);
  }
  entry.from = first + low - kAngleError, entry.width = high - low + 2 * kAngleError;
  return entry;
}

std::size_t FoliageAbout::direction_of(double angle) const {
  const double turns = angle / kWholeTurn;
  return std::min(directions_ - 1,
                  static_cast<std::size_t>((turns - std::floor(turns)) * static_cast<double>(directions_)));
}

template <class Visit>
bool FoliageAbout::for_each_triangle(const Line& line, const Visit& visit) const {
  if (entries_.empty()) return true;
  const std::size_t direction = direction_of(std::atan2(line.dy, line.dx));
  const std::span<const std::uint32_t> list = by_direction_.in(direction);
  const float* highest = highest_.data() + first_few_[direction];
  for (std::size_t first = 0; first < list.size(); first += kFew, ++highest) {
    if (entries_[list[first]].nearest > line.length) break;
    if (*highest <= line.slope) continue;
    for (const std::uint32_t i : list.subspan(first, std::min(kFew, list.size() - first)))
      if (entries_[i].highest > line.slope && entries_[i].nearest <= line.length &&
          !visit(surface_.triangles[entries_[i].triangle]))
        return false;
  }
  return true;
}

bool FoliageAbout::along(const Point3& target, std::vector<Piece>& pieces) const {
  pieces.clear();
  const Line line(eye_, target, drop_);
  return for_each_triangle(line, [&](const Triangle& corners) {
    const std::optional<Sides> sides = sides_of(line, corners);
    if (sides) add_piece(line, corners, *sides, pieces);
    return sides.has_value();
  });
}

bool FoliageAbout::along(const Point3& target, const SectionLine& exact, std::vector<Piece>& pieces) const {
  pieces.clear();
  const Line line(eye_, target, drop_);
  // A line along an edge counts as passing over the triangle to its right, of the two beside it.
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<Edge> beside, over;
  for_each_triangle(line, [&](const Triangle& corners) {
    const Sides sides = exact_sides_of(exact, corners);
    add_piece(line, corners, sides, pieces);
    const auto edge = sides.edge_on_line();
    if (!edge) return true;
    Crossing in = crossing_at(line, corners[edge->first]), out = crossing_at(line, corners[edge->second]);
    if (out.at.distance < in.at.distance) std::swap(in, out);
    const bool is_beside = sides.left[0] == sides.left[1] && sides.left[1] == sides.left[2];
    if (piece_between(line, in, out))
      (is_beside ? beside : over).push_back(std::minmax({corners[edge->first], corners[edge->second]}));
    return true;
  });
  std::sort(beside.begin(), beside.end()), std::sort(over.begin(), over.end());
  return std::includes(over.begin(), over.end(), beside.begin(), beside.end());
}

std::optional<FoliageAbout::Sides> FoliageAbout::sides_of(const Line& line, const Triangle& corners) const {
  Sides sides;
  int on_line = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const GridPoint& p = surface_.vertices[corners[i]];
    sides.side[i] = line.dx * (p.y - eye_.y) - line.dy * (p.x - eye_.x);
    sides.left[i] = sides.side[i] >= 0;
    on_line += std::abs(sides.side[i]) <= kAlongEdge * line.length ? 1 : 0;
  }
  if (on_line > 1) return std::nullopt;
  return sides;
}

FoliageAbout::Sides FoliageAbout::exact_sides_of(const SectionLine& line, const Triangle& corners) const {
  Sides sides;
  for (std::size_t i = 0; i < 3; ++i) {
    const Int128 side = line.side(surface_.vertices[corners[i]]);
    sides.left[i] = (side >= 0) != line.is_mirrored();
    sides.side[i] = static_cast<double>(line.is_mirrored() ? -side : side);
  }
  return sides;
}

void FoliageAbout::add_piece(const Line& line, const Triangle& corners, const Sides& sides,
                             std::vector<Piece>& pieces) const {
  // The corners are counterclockwise, so that the line enters by the edge that comes from its left side.
  Crossing in, out;
  bool crosses = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = i == 2 ? 0 : i + 1;
    if (sides.left[i] == sides.left[j]) continue;
    const Crossing p = crossing_at(line, corners[i]), q = crossing_at(line, corners[j]);
    const double w = sides.side[i] / (sides.side[i] - sides.side[j]);
    const auto between = [w](double a, double b) { return a + w * (b - a); };
    const std::uint16_t theme = sides.side[i] == 0   ? p.theme
                                : sides.side[j] == 0 ? q.theme
                                                     : theme_of_edge(p.theme, q.theme);
    (sides.left[i] ? in : out) = {{between(p.at.distance, q.at.distance), between(p.at.z, q.at.z)}, theme};
    crosses = true;
  }
  if (!crosses || out.at.distance <= in.at.distance) return;
  if (const std::optional<Piece> piece = piece_between(line, in, out)) pieces.push_back(*piece);
}

FoliageAbout::Crossing FoliageAbout::crossing_at(const Line& line, std::uint32_t corner) const {
  const GridPoint& p = surface_.vertices[corner];
  const double along = (p.x - eye_.x) * line.dx + (p.y - eye_.y) * line.dy;
  return {{along * line.per_squared, 1.0 * p.z}, surface_.raised_theme[corner]};
}

std::optional<FoliageAbout::Piece> FoliageAbout::piece_between(const Line& line, const Crossing& in,
                                                               const Crossing& out) const {
  if (out.at.distance <= 0 || in.at.distance >= 1) return std::nullopt;
  const std::uint16_t theme = theme_of_piece(in.theme, in.at.z, out.theme, out.at.z);
  if (theme >= vegetation_.size() || !vegetation_[theme]) return std::nullopt;
  ClearancePiece piece = line.over.piece(in.at, out.at);
  piece.from = std::max(piece.from, 0.0), piece.to = std::min(piece.to, 1.0);
  const auto [from, to] = piece.above_line(grazing_);
  if (to <= from) return std::nullopt;
  return Piece{from, to, theme, in.at.distance == from && in.theme == theme};
}

}  // namespace itin::viewshed
