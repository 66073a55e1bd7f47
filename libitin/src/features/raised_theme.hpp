// Raised features on a store's ground: from footprints to what a store keeps of them, part by part.
//
// A cluster of touching features is kept or dropped as a whole, so that no query sees half of it. A level keeps it if
// the longer side of the box about it is at least the level's lateral tolerance. A part holds the clusters that are
// kept up to the same level. Clusters have numbers where coarser levels drop them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "features/mesh/ground_border.hpp"
#include "features/plan/plan_overlay.hpp"
#include "store/segments/clusters.hpp"
#include "store/segments/footprint_codec.hpp"
#include "store/store_writer.hpp"

namespace itin {

struct RaisedSegment {
  GridPoint a, b;
  bool outline = false;  ///< whether it lies between a feature and the ground
  std::uint32_t cluster = kNoCluster;
};

struct RaisedPart {
  int coarsest = 0;
  std::uint16_t source = 0;  ///< the source of the first of its features
  std::vector<RaisedSegment> segments;
  std::vector<GridPoint> vertices;  ///< in Morton order: the ends of segments, and others
  std::vector<GridPolygon> masks;   ///< where others make way
  std::vector<std::uint32_t> mask_clusters;
  std::vector<FeatureReach> reaches;
};

/// A finding about a feature.
struct RaisedReport {
  std::uint16_t source;  ///< the source of the feature
  std::string text;      ///< one line
};

struct RaisedFeatureTheme {
  ChangedGround ground;
  std::vector<RaisedPart> parts;  ///< the finest first, none without features
  std::vector<RaisedReport> reports;
  std::uint64_t built = 0, refused = 0;
  /// The places, among the footprints that were given, of those that do not stand; ascending. Rasters are never among
  /// them.
  std::vector<std::size_t> left_out;
};

/// The wall offset in metres where no import states one.
double default_wall_offset(const Grid& grid);

/// Raises a theme's footprints; `wall_offset` is in metres. Footprints that reach beyond the ground are refused. Reads
/// the ground in pieces of about a square kilometre; memory follows these and the features. Throws Cancelled, what
/// triangulate() throws, and InputError where the ground about features that hang together takes more than
/// `memory_bytes`.
RaisedFeatureTheme raise_theme(const Store& ground, std::span<const StoredFootprint> footprints, double wall_offset,
                               std::uint64_t memory_bytes, Progress& progress);

}  // namespace itin
