// Whether the certificates of a store hold: law 2, checked on the written store.
#pragma once

#include <vector>

#include "store/store_file.hpp"
#include "triangulate/apex/selection.hpp"
#include "verify/false_cell.hpp"

namespace itin {

/// Returns the selections of a store's terrain at each level.
std::vector<Selection> selections_of_levels(const StoreMetadata& metadata);

/// Compares all levels with the full surface in one tile. Throws Error where there are no surfaces.
std::vector<FalseCell> false_certificates(const StoreFile& file, const std::vector<Selection>& levels,
                                          const Cell& tile);

Damage false_certificate(const FalseCell& cell, const Grid& grid);

/// Finds the levels for which the metadata does not agree with the certificates of their cells.
std::vector<Damage> false_levels(const StoreFile& file);

}  // namespace itin
