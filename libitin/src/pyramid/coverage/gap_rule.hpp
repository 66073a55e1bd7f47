// Decides whether edges and triangles may be ground, by the gap bases of their ends' sources (SourceInfo::gap_basis).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "triangulate/apex/apex.hpp"

namespace itin {

class GapRule {
 public:
  /// `bases` holds a basis per source, in grid units, and must outlive the rule.
  explicit GapRule(const std::vector<std::array<double, 4>>& bases) : bases_(bases) {}

  bool bridges(const SelectedVertex& p, const SelectedVertex& q) const {
    const double x = static_cast<double>(q.point.x) - p.point.x, y = static_cast<double>(q.point.y) - p.point.y;
    return bridges(p.source, x, y) || (p.source != q.source && bridges(q.source, x, y));
  }
  /// Whether this source bridges the sides and diagonals of squares of a lattice with these steps, and nothing longer.
  bool bridges_squares_alone(std::uint16_t source, double x, double y) const {
    const auto& [ux, uy, vx, vy] = bases_[source];
    return bridges(source, x, y) && bridges(source, x, -y) && bridges(source, x, 0) && bridges(source, 0, y) &&
           std::abs(ux) + std::abs(vx) < 2 * x && std::abs(uy) + std::abs(vy) < 2 * y;
  }
  bool ground(const SelectedVertex& a, const SelectedVertex& b, const SelectedVertex& c) const {
    return bridges(a, b) && bridges(b, c) && bridges(c, a);
  }
  /// No edge between points of these sources that may be ground is longer than this in x or in y.
  template <class Sources>
  double reach(const Sources& sources) const {
    double reach = 0;
    for (const auto source : sources) {
      const auto& [ux, uy, vx, vy] = bases_[source];
      reach = std::max({reach, std::abs(ux) + std::abs(vx), std::abs(uy) + std::abs(vy)});
    }
    return std::ceil(reach) + 1;
  }

 private:
  bool bridges(std::uint16_t source, double x, double y) const { return within(bases_[source], x, y); }
  /// Tells whether e = a u + b v with |a| <= 1 and |b| <= 1, by Cramer's rule without the division.
  static bool within(const std::array<double, 4>& basis, double x, double y) {
    const auto& [ux, uy, vx, vy] = basis;
    const double determinant = std::abs(ux * vy - uy * vx);
    return std::abs(x * vy - y * vx) <= determinant && std::abs(ux * y - uy * x) <= determinant;
  }

  const std::vector<std::array<double, 4>>& bases_;
};

}  // namespace itin
