// The difference between two surfaces at every vertex of their overlay, by brute force.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <itin/tin.hpp>

namespace itin::test {

struct Sample {
  Point2 position;
  double difference;
};

inline double cross(Point2 a, Point2 b, Point2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
inline Point2 flat(const Point3& p) {
  return {p.x, p.y};
}

/// Height of a Tin at a point, by looking at every triangle.
inline std::optional<double> height_at(const Tin& tin, Point2 p) {
  for (const Triangle& t : tin.triangles) {
    const Point3 a = tin.point(t[0]), b = tin.point(t[1]), c = tin.point(t[2]);
    const double wa = cross(flat(b), flat(c), p), wb = cross(flat(c), flat(a), p), wc = cross(flat(a), flat(b), p);
    if (wa >= 0 && wb >= 0 && wc >= 0) return (wa * a.z + wb * b.z + wc * c.z) / (wa + wb + wc);
  }
  return std::nullopt;
}

inline std::set<std::pair<std::uint32_t, std::uint32_t>> edges_of(const Tin& tin) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Triangle& t : tin.triangles) {
    for (std::size_t i = 0; i < 3; ++i) edges.insert(std::minmax(t[i], t[(i + 1) % 3]));
  }
  return edges;
}

/// Samples the difference between a surface and a coarser one, whose vertices are among its own; metres.
inline std::vector<Sample> overlay(const Tin& fine, const Tin& coarse) {
  std::vector<Sample> samples;
  for (std::uint32_t v = 0; v < fine.vertices.size(); ++v) {
    const Point3 p = fine.point(v);
    const auto h = height_at(coarse, flat(p));
    EXPECT_TRUE(h.has_value()) << "the coarse surface does not cover " << p.x << " " << p.y;
    if (h) samples.push_back({flat(p), p.z - *h});
  }
  const auto coarse_edges = edges_of(coarse);
  for (const auto& [u, v] : edges_of(fine)) {
    const Point3 a = fine.point(u), b = fine.point(v);
    for (const auto& [w, x] : coarse_edges) {
      const Point3 c = coarse.point(w), d = coarse.point(x);
      if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x)) continue;
      const double ca = cross(flat(c), flat(d), flat(a)), cb = cross(flat(c), flat(d), flat(b));
      const double ac = cross(flat(a), flat(b), flat(c)), ad = cross(flat(a), flat(b), flat(d));
      if (ca * cb >= 0 || ac * ad >= 0) continue;
      const double s = ca / (ca - cb), t = ac / (ac - ad);
      samples.push_back(
          {{a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)}, a.z + s * (b.z - a.z) - c.z - t * (d.z - c.z)});
    }
  }
  return samples;
}

}  // namespace itin::test
