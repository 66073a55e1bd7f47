// The surface's elevation under many positions, and the cost of reading it.
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

/// Finds the heights as heights_at() does.
RetrievedHeights retrieve_heights(const Store& store, const std::vector<Point2>& positions, const Detail& detail,
                                  const ThemeChoice& themes, Progress& progress);

}  // namespace itin
