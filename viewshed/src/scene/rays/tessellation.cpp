#include "scene/rays/tessellation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <itin/parallel.hpp>

namespace itin::viewshed {

namespace {

constexpr std::size_t kTrianglesPerChunk = 1 << 14;

GridPoint centre_of(const Tin& tin) {
  constexpr auto kMax = std::numeric_limits<std::int32_t>::max(), kMin = std::numeric_limits<std::int32_t>::min();
  GridPoint low{kMax, kMax, kMax}, high{kMin, kMin, kMin};
  for (const GridPoint& v : tin.vertices) {
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  const auto middle = [](std::int32_t a, std::int32_t b) {
    return static_cast<std::int32_t>((std::int64_t{a} + b) / 2);
  };
  return {middle(low.x, high.x), middle(low.y, high.y), middle(low.z, high.z)};
}

Point3 about(const GridPoint& centre, const GridPoint& v) {
  return {static_cast<double>(v.x) - centre.x, static_cast<double>(v.y) - centre.y,
          static_cast<double>(v.z) - centre.z};
}

std::array<float, 3> lowered(const Point3& p, double drop) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z - drop * (p.x * p.x + p.y * p.y))};
}

double squared_length(const Point3& a, const Point3& b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

Point3 midpoint(const Point3& a, const Point3& b) {
  return {(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
}

using SpaceCorners = std::array<Point3, 3>;

/// Rotates the longest edge to lie between the first two corners, and returns its squared length.
double longest_edge_first(SpaceCorners& t) {
  const std::array<double, 3> lengths{squared_length(t[0], t[1]), squared_length(t[1], t[2]),
                                      squared_length(t[2], t[0])};
  const auto longest = std::max_element(lengths.begin(), lengths.end());
  std::rotate(t.begin(), t.begin() + (longest - lengths.begin()), t.end());
  return *longest;
}

void cut(SpaceCorners t, double limit, std::vector<SpaceCorners>& pieces) {
  if (longest_edge_first(t) <= limit) {
    pieces.push_back(t);
    return;
  }
  const Point3 middle = midpoint(t[0], t[1]);
  cut({t[0], middle, t[2]}, limit, pieces);
  cut({middle, t[1], t[2]}, limit, pieces);
}

/// Triangles with an edge beyond `limit` (a squared length), in ascending order.
std::vector<std::uint32_t> long_triangles(const Tin& tin, const GridPoint& centre, double limit) {
  const std::size_t count = tin.triangles.size();
  std::vector<std::vector<std::uint32_t>> found((count + kTrianglesPerChunk - 1) / kTrianglesPerChunk);
  parallel_for(found.size(), [&](std::size_t chunk) {
    for (std::size_t t = chunk * kTrianglesPerChunk; t < std::min(count, (chunk + 1) * kTrianglesPerChunk); ++t) {
      const Triangle& c = tin.triangles[t];
      SpaceCorners corners{about(centre, tin.vertices[c[0]]), about(centre, tin.vertices[c[1]]),
                           about(centre, tin.vertices[c[2]])};
      if (longest_edge_first(corners) > limit) found[chunk].push_back(static_cast<std::uint32_t>(t));
    }
  });
  std::vector<std::uint32_t> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// Replaces each of the given triangles by its pieces, all but the first at the end.
void replace_by_pieces(const Tin& tin, const std::vector<std::uint32_t>& triangles, double drop, double limit,
                       Tessellation& result) {
  std::vector<SpaceCorners> pieces;
  for (const std::uint32_t t : triangles) {
    const Triangle& c = tin.triangles[t];
    pieces.clear();
    cut({about(result.centre, tin.vertices[c[0]]), about(result.centre, tin.vertices[c[1]]),
         about(result.centre, tin.vertices[c[2]])},
        limit, pieces);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const auto first = static_cast<std::uint32_t>(result.vertices.size() / 3);
      for (const Point3& p : pieces[i]) {
        const auto v = lowered(p, drop);
        result.vertices.insert(result.vertices.end(), v.begin(), v.end());
      }
      const std::array<std::uint32_t, 3> corners{first, first + 1, first + 2};
      if (i == 0) {
        std::copy(corners.begin(), corners.end(), result.indices.begin() + 3 * static_cast<std::ptrdiff_t>(t));
      } else {
        result.indices.insert(result.indices.end(), corners.begin(), corners.end());
        result.parents.push_back(t);
      }
    }
  }
}

}  // namespace

Tessellation tessellate(const Tin& tin, double drop) {
  Tessellation result;
  result.centre = centre_of(tin);
  result.vertices.resize(3 * tin.vertices.size());
  const std::size_t chunks = (tin.vertices.size() + kTrianglesPerChunk - 1) / kTrianglesPerChunk;
  parallel_for(chunks, [&](std::size_t chunk) {
    for (std::size_t v = chunk * kTrianglesPerChunk;
         v < std::min(tin.vertices.size(), (chunk + 1) * kTrianglesPerChunk); ++v) {
      const auto p = lowered(about(result.centre, tin.vertices[v]), drop);
      std::copy(p.begin(), p.end(), result.vertices.begin() + 3 * static_cast<std::ptrdiff_t>(v));
    }
  });
  result.indices.reserve(3 * tin.triangles.size());
  for (const Triangle& t : tin.triangles) result.indices.insert(result.indices.end(), t.begin(), t.end());

  if (drop != 0) {
    const double limit = 3 * kSag / tin.grid.resolution / std::abs(drop);
    const std::vector<std::uint32_t> cut_triangles = long_triangles(tin, result.centre, limit);
    if (!cut_triangles.empty()) {
      result.parents.resize(tin.triangles.size());
      for (std::uint32_t t = 0; t < result.parents.size(); ++t) result.parents[t] = t;
      replace_by_pieces(tin, cut_triangles, drop, limit, result);
    }
  }
  for (std::size_t i = 0; i < result.vertices.size(); ++i) {
    double& extent = i % 3 == 2 ? result.half_height : result.half_width;
    extent = std::max(extent, static_cast<double>(std::abs(result.vertices[i])));
  }
  return result;
}

}  // namespace itin::viewshed
