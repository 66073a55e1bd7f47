// A triangulated piece of the surface: what a window query returns.
//
//   const Tin tin = triangulate(store, Window::disc({318000, 176000}, 500), Detail::tolerance(0), progress);
//   for (std::uint32_t t = 0; t < tin.triangles.size(); ++t)
//     for (const GridPoint& corner : tin.corners(t)) std::cout << tin.grid.point(corner).z << '\n';
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include <itin/geometry.hpp>

namespace itin {

class RasterGrid;

/// The Morton code of a vertex's grid position: unique in a store, and equal in every query, level and import order.
using VertexId = std::uint64_t;

/// Three indices into Tin::vertices, counterclockwise seen from above, the smallest first.
using Triangle = std::array<std::uint32_t, 3>;

/// An edge that is part of a line. Its ends are indices into Tin::vertices, the smaller first.
struct LineEdge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::uint16_t theme = 0;  ///< StoreMetadata::themes[theme - 1]
  friend auto operator<=>(const LineEdge&, const LineEdge&) = default;
};

/// The cost of retrieving a window.
struct RetrievalStatistics {
  std::uint64_t points_read = 0;  ///< points decoded, used or not
  std::uint64_t blocks_read = 0;  ///< blocks fetched, from cache or disk
  RetrievalStatistics& operator+=(const RetrievalStatistics& s) {
    points_read += s.points_read;
    blocks_read += s.blocks_read;
    return *this;
  }
};

/// An immutable triangulation. Vertices are in ascending order of their VertexId, triangles in ascending order of
/// their indices: two Tins of the same query are equal byte for byte. Only ground is present: a hole in the coverage
/// is a hole here. A vertex is listed if and only if a triangle uses it.
struct Tin {
  Grid grid;
  std::vector<GridPoint> vertices;
  std::vector<std::uint16_t> sources;  ///< per vertex: index into StoreMetadata::sources
  std::vector<Triangle> triangles;
  RetrievalStatistics statistics;
  /// For each vertex, the theme (from 1) of the raised feature that it is part of, off the feature's outline; 0: none.
  /// The list is empty where no vertex is part of one.
  std::vector<std::uint16_t> raised_theme;
  std::vector<LineEdge>
      lines;  ///< the lines of every theme present, ascending; an edge that themes share comes once for each

  /// Returns the corners of a triangle, counterclockwise.
  std::array<GridPoint, 3> corners(std::uint32_t triangle) const {
    const auto& [a, b, c] = triangles[triangle];
    return {vertices[a], vertices[b], vertices[c]};
  }
  Point3 point(std::uint32_t vertex) const { return grid.point(vertices[vertex]); }
  /// Returns the theme (from 1) of the raised feature that the triangle is part of; 0 for ground.
  std::uint16_t theme(const Triangle& t) const;
  VertexId id(std::uint32_t vertex) const;
  /// The smallest box of all vertices, metres.
  Box bounds() const;
};

/// Returns the surface through heights at the centres of a raster's cells, which are the posts: what triangulate()
/// gives for all of a store of that raster at tolerance 0, without a store. Heights are metres, row by row; where one
/// is not finite, there is no post. Heights, and distances from the north-western post, are rounded to the resolution.
///
///   const Tin tin = surface_through(grid, heights);
///   const viewshed::Result result = viewshed::compute(tin, request, progress);
///
/// O(n log n). Throws InputError for another number of heights, fewer than 2 columns or rows, a resolution that is not
/// positive, a raster or heights beyond 2^31 times the resolution, and where there is no triangle.
Tin surface_through(const RasterGrid& posts, std::span<const float> heights, double resolution = 0.01);

}  // namespace itin
