// What lies near an observer, decided exactly: there a coarse level decides least, and people look first.
#pragma once

#include <optional>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/result.hpp>

#include "judge/block_judge.hpp"

namespace itin::viewshed {

class Surroundings {
 public:
  /// All must outlive it.
  Surroundings(const Store& store, const Request& request, const RasterGrid& grid);

  /// Decides the cells of the grid near an observer; nothing where no cell lies that near. Adds the lines that this
  /// takes to the statistics. Throws what compute_with_surface() throws.
  std::optional<ExactNearby> decide(const Observer& observer, Statistics& statistics, const Progress& progress) const;

 private:
  double reach_of(const Observer& observer) const;

  const Store& store_;
  const Request& request_;
  const RasterGrid& grid_;
  double points_;  ///< about how many points of the full surface are read about each observer
};

}  // namespace itin::viewshed
