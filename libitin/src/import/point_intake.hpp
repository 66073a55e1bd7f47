// Collects and sorts all points of an import, and once more those of the ground that lines make room for.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "pyramid/points/sorted_points.hpp"
#include "pyramid/points/source_index.hpp"
#include "pyramid/replacing_ground.hpp"

namespace itin {

class PointIntake {
 public:
  /// `replacing` are the sources whose ground lines make room for; none where no lines do. The other arguments are
  /// those of PointSorter.
  PointIntake(const std::string& directory, std::uint64_t memory_bytes, Sources replacing);

  void add(const RawPoint& point) { add({&point, 1}); }
  void add(std::span<const RawPoint> points);
  /// Gives sources other numbers, as PointSorter does, once all points have been added.
  void renumber(const std::vector<std::uint16_t>& numbers);
  /// Finds the ground that lines make room for; nothing where there is none. To be called once, after all points of the
  /// ground.
  std::optional<ReplacingGround> replacing_ground(const std::vector<SourceInfo>& sources, const Grid& grid,
                                                  Progress& progress);
  /// Sorts all points as PointSorter does.
  SortedPoints finish(const std::vector<SourceInfo>& sources, Progress& progress, std::uint64_t* duplicates);

 private:
  PointSorter all_;
  Sources replacing_;
  std::optional<PointSorter> of_replacing_;
};

}  // namespace itin
