#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include <profile/line_of_sight.hpp>

#include "triangle_buckets.hpp"

namespace itin::profile {

namespace {

/// A point of the cross-section: how far along the line (0 at its start, 1 at its end), and how high the surface is.
struct Crossing {
  double t = 0;
  double z = 0;
};

/// A piece of the cross-section within one triangle.
struct Piece {
  Crossing from;
  Crossing to;
};

/// The line from the lesser to the greater end in (x, y, z): whichever was given first, all arithmetic is the same.
class Course {
 public:
  Course(Point3 a, Point3 b) : start_(a), end_(b) {
    if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z)) std::swap(start_, end_);
    dx_ = end_.x - start_.x;
    dy_ = end_.y - start_.y;
    length_ = std::hypot(dx_, dy_);
  }

  double length() const { return length_; }
  Point2 start() const { return {start_.x, start_.y}; }
  Point2 end() const { return {end_.x, end_.y}; }
  Point3 point(const Crossing& c) const { return {start_.x + c.t * dx_, start_.y + c.t * dy_, c.z}; }
  double ray(double t) const { return (1 - t) * start_.z + t * end_.z; }

  /// Twice the signed area of the triangle start, end, p: positive to the left.
  double side(const Point3& p) const { return dx_ * (p.y - start_.y) - dy_ * (p.x - start_.x); }
  double along(const Point3& p) const {
    return ((p.x - start_.x) * dx_ + (p.y - start_.y) * dy_) / (length_ * length_);
  }

 private:
  Point3 start_, end_;
  double dx_ = 0, dy_ = 0, length_ = 0;
};

/// Where the line through both ends cuts an edge. Called with the edge's ends in one order from either triangle, so
/// that neighbouring pieces share their end to the last bit.
Crossing crossing(const Course& course, const Point3& p, const Point3& q) {
  const double sp = course.side(p), sq = course.side(q);
  const double s = sp / (sp - sq);
  const double tp = course.along(p), tq = course.along(q);
  return {tp + s * (tq - tp), p.z + s * (q.z - p.z)};
}

/// The height of a piece at t, between its ends.
double height_at(const Piece& piece, double t) {
  const double width = piece.to.t - piece.from.t;
  return width > 0 ? piece.from.z + (t - piece.from.t) / width * (piece.to.z - piece.from.z) : piece.from.z;
}

/// The part of the line inside a closed triangle and between the ends.
std::optional<Piece> piece_of(const Course& course, const Tin& tin, const Triangle& triangle) {
  std::array<Point3, 3> corners;
  std::array<double, 3> sides{};
  std::array<Crossing, 6> crossings;
  std::size_t count = 0;
  for (int i = 0; i < 3; ++i) {
    corners[i] = tin.point(triangle[i]);
    sides[i] = course.side(corners[i]);
    if (sides[i] == 0) crossings[count++] = {course.along(corners[i]), corners[i].z};
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (sides[i] * sides[j] >= 0) continue;
    const bool in_order = triangle[i] < triangle[j];
    crossings[count++] = crossing(course, corners[in_order ? i : j], corners[in_order ? j : i]);
  }
  if (count == 0) return std::nullopt;
  const auto by_t = [](const Crossing& a, const Crossing& b) { return a.t < b.t; };
  const auto [first, last] = std::minmax_element(crossings.begin(), crossings.begin() + count, by_t);
  Piece piece{*first, *last};
  if (piece.to.t < 0 || piece.from.t > 1) return std::nullopt;
  const Piece whole = piece;
  if (piece.from.t < 0) piece.from = {0, height_at(whole, 0)};
  if (piece.to.t > 1) piece.to = {1, height_at(whole, 1)};
  return piece;
}

/// Barycentric height of the surface at a point, if the triangle contains it.
std::optional<double> height_at(const Tin& tin, const Triangle& triangle, Point2 p) {
  const Point3 a = tin.point(triangle[0]), b = tin.point(triangle[1]), c = tin.point(triangle[2]);
  const auto area = [&](const Point3& u, const Point3& v) {
    return (u.x - p.x) * (v.y - p.y) - (u.y - p.y) * (v.x - p.x);
  };
  const double wa = area(b, c), wb = area(c, a), wc = area(a, b);
  if (wa < 0 || wb < 0 || wc < 0) return std::nullopt;
  return (wa * a.z + wb * b.z + wc * c.z) / (wa + wb + wc);
}

}  // namespace

class SightLines::Impl {
 public:
  Impl(const Tin& tin, const Earth& earth) : tin_(&tin), buckets_(tin), curvature_(earth.drop_coefficient()) {}

  SightLine between(Point3 a, Point3 b) const {
    const Course course(a, b);
    SightLine line;
    line.length = course.length();
    const std::vector<std::uint32_t> triangles = buckets_.near(course.start(), course.end());
    if (line.length == 0) return standing(course, triangles);
    Crossing critical;
    for (const std::uint32_t t : triangles) {
      const std::optional<Piece> piece = piece_of(course, *tin_, tin_->triangles[t]);
      if (piece) lower(course, *piece, line.clearance, critical);
    }
    if (line.clearance) line.critical = course.point(critical);
    return line;
  }

 private:
  /// Both ends stand at one position.
  SightLine standing(const Course& course, const std::vector<std::uint32_t>& triangles) const {
    SightLine line;
    for (const std::uint32_t t : triangles) {
      const std::optional<double> z = height_at(*tin_, tin_->triangles[t], course.start());
      if (!z || line.clearance) continue;
      line.clearance = course.ray(0) - *z;
      line.critical = {course.start().x, course.start().y, *z};
    }
    return line;
  }

  double clearance_at(const Course& course, const Crossing& c) const {
    // The chord between both ends dips below the curved surface by drop(d1 + d2) - drop(d1) - drop(d2).
    const double bulge = curvature_ * course.length() * course.length() * c.t * (1 - c.t);
    return course.ray(c.t) - c.z - bulge;
  }

  /// Lowers `least` to the least clearance over the piece.
  void lower(const Course& course, const Piece& piece, std::optional<double>& least, Crossing& critical) const {
    const auto consider = [&](const Crossing& c) {
      const double clearance = clearance_at(course, c);
      if (!least || clearance < *least || (clearance == *least && c.t < critical.t)) {
        least = clearance;
        critical = c;
      }
    };
    consider(piece.from);
    consider(piece.to);
    const double width = piece.to.t - piece.from.t;
    const double convexity = 2 * curvature_ * course.length() * course.length();
    if (width <= 0 || convexity <= 0) return;
    // d/dt of ray - surface - bulge is zero here; a convex quadratic has its minimum where that lies within the piece.
    const double slope = (course.ray(1) - course.ray(0)) - (piece.to.z - piece.from.z) / width;
    const double t = 0.5 - slope / convexity;
    if (t > piece.from.t && t < piece.to.t) consider({t, height_at(piece, t)});
  }

  const Tin* tin_;
  TriangleBuckets buckets_;
  double curvature_;  ///< the drop over d is curvature_ d^2
};

SightLines::SightLines(const Tin& tin, const Earth& earth) : impl_(std::make_unique<Impl>(tin, earth)) {}
SightLines::SightLines(SightLines&&) noexcept = default;
SightLines& SightLines::operator=(SightLines&&) noexcept = default;
SightLines::~SightLines() = default;

SightLine SightLines::between(Point3 a, Point3 b) const {
  return impl_->between(a, b);
}

}  // namespace itin::profile
