// The surface's elevation under many positions, and what reading it cost.
#pragma once

#include <optional>
#include <vector>

#include <itin/store.hpp>
#include <itin/triangulate.hpp>

namespace itin {

struct RetrievedHeights {
  std::vector<std::optional<double>> metres;  ///< one for each position, in order
  RetrievalStatistics statistics;
};

/// As heights_at() has it.
RetrievedHeights retrieve_heights(const Store& store, const std::vector<Point2>& positions, const Detail& detail,
                                  const ThemeChoice& themes, Progress& progress);

}  // namespace itin
