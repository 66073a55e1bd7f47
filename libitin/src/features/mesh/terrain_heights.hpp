// Heights of the ground under features, exactly those of a triangulation: at positions, along edges, under footprints.
//
//   const TerrainHeights terrain(tin);                    // the full surface, in a window about the features
//   std::optional<double> z = terrain.height_at(p);       // metres; nothing outside the triangulation
//   std::optional<double> base = terrain.base_height(footprint, BaseRule::mean);
//
// Immutable and safe for concurrent use. Refers to the Tin, which must outlive it. About 12 bytes per triangle; a
// look-up takes time proportional to the triangles near it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <itin/box_of.hpp>
#include <itin/bucket_lists.hpp>
#include <itin/tin.hpp>

#include "features/plan/plan_overlay.hpp"
#include "store/segments/footprint.hpp"

namespace itin {

class TerrainHeights {
 public:
  explicit TerrainHeights(const Tin& tin);

  const Grid& grid() const { return tin_->grid; }
  std::optional<double> height_at(Position p) const;

  /// The positions where edges of the triangulation meet the open segment ab, rounded to the grid, in order from a. An
  /// edge along ab gives its ends.
  std::vector<Position> crossings(Position a, Position b) const;

  /// Indices, ascending, of the triangles whose boxes meet the box.
  std::vector<std::uint32_t> triangles_near(const GridBox& box) const;
  /// Whether the triangles near a box are all level and equally high. May be false where only triangles a little
  /// further away are not.
  bool level_about(const GridBox& box) const;
  /// The triangles within `reach` grid steps of the closed segment ab, and perhaps some a little further off,
  /// ascending.
  std::vector<std::uint32_t> triangles_along(Position a, Position b, std::int32_t reach = 0) const;
  const Triangle& triangle(std::uint32_t t) const { return tin_->triangles[t]; }
  const GridPoint& vertex(std::uint32_t v) const { return tin_->vertices[v]; }
  GridBox box_of_triangle(std::uint32_t t) const { return box_of(tin_->corners(t)); }

  /// The height in metres that the rule asks for, over the part of the footprint that lies on the triangulation;
  /// nothing if there is none. The least and greatest heights are found at vertices inside, at the outline's vertices
  /// and where the outline crosses edges. The mean is the integral over the area. terrain_following asks for the mean.
  std::optional<double> base_height(const GridPolygons& footprint, BaseRule rule) const;

 private:
  struct Extremes;
  class FootprintIntegral;
  struct Crossing {
    double along;  ///< 0 to 1
    Position at;
    double height;  ///< grid units, where the edges meet, while `at` is rounded
    friend auto operator<=>(const Crossing&, const Crossing&) = default;
  };
  std::vector<Crossing> all_crossings(Position a, Position b) const;
  GridBox bucket_range(const GridBox& box) const;
  std::size_t bucket(std::int32_t column, std::int32_t row) const {
    return static_cast<std::size_t>(row) * columns_ + column;
  }
  void fill_buckets();
  std::optional<double> mean_height(const GridPolygons& footprint, const std::vector<std::uint32_t>& near) const;
  void add_outline(const GridPolygons& footprint, Extremes& extremes) const;

  const Tin* tin_;
  GridBox bounds_;
  std::int64_t bucket_side_ = 1;
  std::int32_t columns_ = 0, rows_ = 0;
  BucketLists triangles_;  ///< by bucket
};

GridBox bounds_of(const GridPolygons& polygons);

}  // namespace itin
