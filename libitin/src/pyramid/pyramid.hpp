// The Delaunay pyramid: from sorted points to a written store.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "pyramid/points/sorted_points.hpp"
#include "pyramid/theme_lines.hpp"
#include "store/store_writer.hpp"

namespace itin {

/// The kind of a source of points that are inferred from contours. No file stands for it.
inline constexpr const char* kInferred = "inferred";

/// The kind of a source that fills missing ground with the sea. No file stands for it.
inline constexpr const char* kSea = "sea";
bool is_sea(const SourceInfo& source);

/// Whether a source's points are ground by themselves: all but the points of lines that add to it, and points inferred
/// in it.
bool is_ground(const SourceInfo& source);

struct PyramidReport {
  std::uint64_t replaced = 0;  ///< coarser points that were dropped for finer ones
  std::uint64_t isolated = 0;  ///< points left out because there is no ground about them
  std::vector<std::uint64_t> vertices_of_source;
  std::uint64_t left_out = 0;                ///< segments of lines that are not wholly on the ground
  std::vector<std::uint64_t> segments;       ///< number of segments of the full surface, by theme and then by part
  std::vector<std::uint64_t> line_vertices;  ///< by theme and then by part
  std::vector<Segment> placed;               ///< lines on the ground, as segments of the full surface
  std::vector<SegmentFeature> of_features;   ///< the features that the placed segments belong to
  std::uint64_t flat_before = 0;             ///< flat triangles of contours (features/contours/flat_triangles.hpp)
  std::uint64_t flat_after = 0;              ///< flat triangles that the repair did not mend
};

/// The sources that a pyramid is built from.
struct PyramidSources {
  SortedPoints& points;  ///< the vertices of terrain lines among them; where contours are repaired, points are added
  const std::vector<SourceInfo>& sources;  ///< they give the gap bases
  const Grid& grid;
  const std::vector<double>& tolerances;  ///< tolerances of the levels, metres
  const ThemeLines& lines;
  const std::vector<GridPoint>* inferred = nullptr;  ///< points from an earlier repair of contours, in Morton order
};

/// Finds the coverage, gives every point its level, certifies the levels and writes it all. Works out of core: memory
/// follows the leaves (about 100 bytes for 512 points) and the tiles in work, not the points. The result depends on the
/// set of points, the lines and the gap bases alone. Contours are repaired (contour_repair.hpp) where one of the
/// sources is kInferred. This source gets the inferred points, or those of an earlier repair if they are given. Throws
/// FileError, Cancelled.
PyramidReport build_pyramid(const PyramidSources& of, StoreWriter& writer, Progress& progress);

}  // namespace itin
