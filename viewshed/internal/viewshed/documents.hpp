// Viewsheds and horizons as JSON documents, in the names that stay; and the parts that documents of other results
// share.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <itin/document.hpp>
#include <viewshed/horizon.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/result.hpp>

namespace itin::viewshed {

struct PlanFile;

/// `grid`: `bounds`, `columns`, `rows`, `cell_m`.
Document grid_document(const RasterGrid& grid);

/// `statistics`: what was read, and how many sight lines were decided; without the times.
Document statistics_document(const Statistics& statistics);

/// The percentage of the cells within fields of view that are decided.
double decided_percent(const CellCounts& cells);

/// How many cells in view a mode has no value for.
struct CellsWithoutValue {
  const char* value;  ///< height, probability, loss or level
  std::uint64_t cells = 0;
};
/// Returns the cells without a value in kHeight, kProbability, kLoss or kLevel; nothing in other modes.
std::optional<CellsWithoutValue> cells_without_value(const Result& result);

/// How many cells have a margin over the sensitivity.
struct CellsWithMargin {
  double margin_db = 0;
  std::size_t band = 0;  ///< the weakest of the levels' bands that has it
  std::uint64_t cells = 0;
};
/// Returns the cells with each of the request's margins in kLevel, or with none to spare; nothing in other modes and
/// without a sensitivity.
std::vector<CellsWithMargin> cells_with_margins(const Result& result);

/// How many cells an observer serves best.
struct CellsOfObserver {
  std::size_t observer = 0;  ///< from 0
  std::uint64_t cells = 0;
};
/// Returns the observers in their order with the cells where their level is the greatest, in kLevel of several
/// observers: with a sensitivity, only where that is reached. Nothing otherwise.
std::vector<CellsOfObserver> cells_of_observers(const Result& result);

/// Returns `crs`, `surface`, `refraction`, `grid`, `cells`, `area_m2` and `statistics`, and for a certified result
/// `decided_percent` and `decided_exactly`.
Document viewshed_document(const StoreMetadata& metadata, const Result& result);

/// Returns the features that hide cells in mode kBlocker, with their theme, name and id by their source (null where it
/// gives none), number and cells; the feature that hides most comes first.
Document blockers_document(const Store& store, const Result& result);

/// Adds to such a document how much of the area looked at has no ground: `no_data` among `cells` and `area_m2`,
/// `beyond_the_data`, and `share_without_data`.
void add_missing_ground(const MissingGround& missing, Document& document);

/// The sky line, a row for each azimuth.
std::string horizon_csv(const Horizon& horizon, const StoreMetadata& metadata);

/// `outputs`: the paths of files, and what is in them.
Document outputs_document(const std::vector<PlanFile>& files);

/// The horizon's targets.
Document targets_document(const Horizon& horizon);

}  // namespace itin::viewshed
