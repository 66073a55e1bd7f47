// Viewsheds and horizons as JSON documents, in the names that stay; and the parts that documents of other results
// share.
#pragma once

#include <cstdint>
#include <optional>

#include <itin/document.hpp>
#include <viewshed/horizon.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// `grid`: `bounds`, `columns`, `rows`, `cell_m`.
Document grid_document(const RasterGrid& grid);

/// `statistics`: what was read, and how many sight lines were decided; without the times.
Document statistics_document(const Statistics& statistics);

/// How many of the cells within fields of view are decided.
double decided_percent(const CellCounts& cells);

/// Cells in view that a mode has no value of.
struct CellsWithoutValue {
  const char* value;  ///< height, probability or loss
  std::uint64_t cells = 0;
};
/// The cells without a value in kHeight, kProbability or kLoss; nothing in other modes.
std::optional<CellsWithoutValue> cells_without_value(const Result& result);

/// `crs`, `surface`, `refraction`, `grid`, `cells`, `area_m2`, of a certified one `decided_percent` and
/// `decided_exactly`, and `statistics`.
Document viewshed_document(const StoreMetadata& metadata, const Result& result);

/// Mode kBlocker: the features that hide cells, with their theme, name and id by their source (null where it gives
/// none), number and cells; what hides most first.
Document blockers_document(const Store& store, const Result& result);

/// Adds to such a document how much of the area looked at has no ground: `no_data` among `cells` and `area_m2`,
/// `beyond_the_data`, and `share_without_data`.
void add_missing_ground(const MissingGround& missing, Document& document);

/// The horizon's targets.
Document targets_document(const Horizon& horizon);

}  // namespace itin::viewshed
