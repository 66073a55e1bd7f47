// Reads back the sources that a store was made from, for another import.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/import.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "import/point_intake.hpp"
#include "import/vectors/line_collection.hpp"

namespace itin {

/// Whether a store's contours are repaired. The store may be null, here and below.
bool repairs(const Store* store);
/// Whether a store's contours will be repaired after an import into it: yes, unless any import of contours said
/// otherwise.
bool will_repair(const ImportOptions& options, const Store* store);

/// The sources of a store, without the last one if that stands for inferred points.
std::vector<SourceInfo> imported_sources(const Store* store);

struct StoredPoints {
  std::uint64_t count = 0;          ///< points of the ground without the inferred ones
  std::vector<GridPoint> inferred;  ///< from contours; in Morton order
};

/// Adds the points of the ground that a store has imported, even those that its surface leaves out, and takes its lines
/// over. Comes after LineCollection::take_themes(). Throws CorruptStore, Cancelled.
StoredPoints add_stored_ground(const Store& store, PointIntake& intake, LineCollection& lines, Progress& progress);

}  // namespace itin
