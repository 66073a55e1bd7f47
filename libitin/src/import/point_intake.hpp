// All points of an import on their way into order, and those of ground that lines make room for once more.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "pyramid/replacing_ground.hpp"
#include "pyramid/sorted_points.hpp"
#include "pyramid/source_index.hpp"

namespace itin {

class PointIntake {
 public:
  /// `replacing`: the sources whose ground lines make room for; none where no lines do. Otherwise as PointSorter.
  PointIntake(const std::string& directory, std::uint64_t memory_bytes, Sources replacing);

  void add(const RawPoint& point) { add({&point, 1}); }
  void add(std::span<const RawPoint> points);
  /// The ground that lines make room for; nothing where there is none. Once, after all points of the ground.
  std::optional<ReplacingGround> replacing_ground(const std::vector<SourceInfo>& sources, const Grid& grid,
                                                  Progress& progress);
  /// All points, as PointSorter has them.
  SortedPoints finish(const std::vector<SourceInfo>& sources, Progress& progress, std::uint64_t* duplicates);

 private:
  PointSorter all_;
  Sources replacing_;
  std::optional<PointSorter> of_replacing_;
};

}  // namespace itin
