#include "request/void_shadow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <itin/same_place.hpp>

#include "bounds/boundary.hpp"
#include "line/infinity.hpp"
#include "request/request.hpp"
#include "request/request_window.hpp"

namespace itin::viewshed {

namespace {

constexpr std::size_t kSectors = 4096;
constexpr double kTurn = 2 * std::numbers::pi;

}  // namespace

double VoidShadow::cross(const Vector& a, const Vector& b) {
  return a.x * b.y - a.y * b.x;
}

double VoidShadow::dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y;
}

/// Tells whether a place on the straight line through `line` lies on it, past the eye.
bool VoidShadow::reaches(const Vector& line, const Vector& place) {
  return dot(line, place) > 0 && dot(place, place) <= dot(line, line);
}

VoidShadow::VoidShadow(const std::vector<RimEdge>& rim, const Point3& eye, NoData rule)
    : eye_(eye), shaded_(rule == NoData::kUnknown ? Verdict::kUndecided : Verdict::kHidden) {
  const auto from_eye = [&](const GridPlace& p) { return Vector{p.x - eye.x, p.y - eye.y}; };
  // The surface lies to the left: seen from its right side it begins here.
  const auto faces_away = [](const Edge& edge) { return cross(edge.from, edge.to) < 0; };
  edges_.reserve(rim.size());
  for (const RimEdge& edge : rim) edges_.push_back({from_eye(edge.from), from_eye(edge.to)});
  if (std::none_of(edges_.begin(), edges_.end(), faces_away)) {
    edges_ = {};
    return;
  }
  sectors_.resize(kSectors);
  for (std::uint32_t i = 0; i < edges_.size(); ++i) {
    // From its right side an edge runs clockwise. One sector more on both sides guards against rounding.
    const Edge& edge = edges_[i];
    const bool away = faces_away(edge);
    const std::size_t end = (sector_of(away ? edge.to : edge.from) + 1) % kSectors;
    for (std::size_t s = (sector_of(away ? edge.from : edge.to) + kSectors - 1) % kSectors;; s = (s + 1) % kSectors) {
      sectors_[s].push_back(i);
      if (s == end) break;
    }
  }
}

bool VoidShadow::holds(double x, double y) const {
  if (sectors_.empty()) return false;
  const Vector line{x - eye_.x, y - eye_.y};
  if (same_place(line.x, line.y)) return false;
  const Numbers& edges = sectors_[sector_of(line)];
  return std::any_of(edges.begin(), edges.end(), [&](std::uint32_t i) {
    const auto& [a, b] = edges_[i];
    const Vector along{b.x - a.x, b.y - a.y};
    const double side_of_a = cross(line, a), side_of_b = cross(line, b);
    if (side_of_a == 0 && reaches(line, a) && comes_from_void(edges, a)) return true;
    if (side_of_b == 0 && reaches(line, b) && comes_from_void(edges, b)) return true;
    const bool crosses = (side_of_a < 0 && side_of_b > 0) || (side_of_a > 0 && side_of_b < 0);
    return crosses && cross(along, a) > 0 && cross(along, {line.x - a.x, line.y - a.y}) >= 0;
  });
}

/// Tells whether the line from the eye comes to this corner of the rim across ground without data. The first of all
/// edges that end in the corner, clockwise from the line, tells on which side of it the line lies.
bool VoidShadow::comes_from_void(const Numbers& edges, const Vector& corner) const {
  const Vector to_eye{-corner.x, -corner.y};
  double nearest = kTurn;
  bool from_void = false;
  for (const std::uint32_t i : edges) {
    const auto& [a, b] = edges_[i];
    const bool ends_here = b == corner;
    if (!ends_here && a != corner) continue;
    const Vector along = ends_here ? Vector{a.x - b.x, a.y - b.y} : Vector{b.x - a.x, b.y - a.y};
    const double left = cross(along, to_eye), ahead = dot(along, to_eye);
    if (left == 0 && ahead > 0) return false;
    const double angle = std::atan2(left, ahead), clockwise = angle < 0 ? angle + kTurn : angle;
    if (clockwise < nearest) nearest = clockwise, from_void = ends_here;
  }
  return from_void;
}

void VoidShadow::apply_to(const TileCentres& centres, TileValues<Verdict>& values) const {
  if (sectors_.empty()) return;
  for (std::size_t cell = 0; cell < values.size(); ++cell) {
    const Point2 place = centres.at(cell);
    if (values[cell] == Verdict::kVisible && holds(place.x, place.y)) values[cell] = shaded_;
  }
}

std::size_t VoidShadow::sector_of(const Vector& place) {
  const double turns = std::atan2(place.x, place.y) / kTurn + 0.5;
  return std::min(kSectors - 1, static_cast<std::size_t>(turns * kSectors));
}

std::uint64_t bytes_of_shadow(std::size_t edges) {
  constexpr std::uint64_t kInSectors = 18;  // an edge spans three sectors and more; as measured
  return kSectors * sizeof(std::vector<std::uint32_t>) + edges * (sizeof(RimEdge) + kInSectors);
}

std::shared_ptr<const VoidShadow> shadow_of(const Eye& eye, const std::vector<RimEdge>& rim, const Result& result) {
  const NoData rule = result.request.nodata;
  if (rule == NoData::kClear || !result.crosses_voids) return nullptr;
  return std::make_shared<const VoidShadow>(rim, eye.units, rule);
}

bool may_cross_voids(const Grid& units, const std::vector<RimEdge>& rim, Point2 position, double radius) {
  return may_cross_voids(units, rim, position, radius, square_about(position, radius));
}

bool may_cross_voids(const Grid& units, const std::vector<RimEdge>& rim, Point2 position, double radius,
                     const Box& ends) {
  const Box within = intersection(ends, square_about(position, radius));
  return surface_resumes(units, rim, position, radius, hull_about(position, within));
}

void find_voids(const Grid& units, const std::vector<RimEdge>& rim, Result& result) {
  for (const Observer& observer : result.request.observers) {
    const double reach = radius_of(result.request, observer).value_or(kInfinity);
    result.crosses_voids =
        result.crosses_voids || may_cross_voids(units, rim, observer.position, reach, result.grid.bounds());
  }
}

}  // namespace itin::viewshed
