// Writes the lines and the raised features of a store onto ground that has been written already.
//
//   LineWriter(lines, placed, ground, writer, report).run(segments, features, progress);
#pragma once

#include <span>
#include <vector>

#include <itin/progress.hpp>

#include "pyramid/pyramid.hpp"
#include "pyramid/theme_lines.hpp"
#include "store/codec/point_index.hpp"
#include "store/segments/segment_features.hpp"
#include "store/store_writer.hpp"

namespace itin {

class LineWriter {
 public:
  /// `ground` has the full surface's points and no others. Counts are added to the report, whose vertices_of_source has
  /// every source. All arguments must outlive the object.
  LineWriter(const ThemeLines& lines, const PlacedLines& placed, const PointIndex& ground, StoreWriter& writer,
             PyramidReport& report)
      : lines_(lines), placed_(placed), ground_(ground), writer_(writer), report_(report) {}

  /// Writes vertices, parts and segments. `segments` are the ground's outline and the segments of the terrain's lines
  /// at all levels; `features` are those of all segments, ascending.
  void run(std::vector<Segment> segments, std::span<const SegmentFeature> features, Progress& progress);

 private:
  std::vector<GridPoint> write_draped(Progress& progress);
  void write_vertices(const std::vector<ThemeVertex>& crossings, const std::vector<GridPoint>& draped);
  void count();

  const ThemeLines& lines_;
  const PlacedLines& placed_;
  const PointIndex& ground_;
  StoreWriter& writer_;
  PyramidReport& report_;
};

}  // namespace itin
