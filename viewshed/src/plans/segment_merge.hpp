// The whole result in the making, with its cells or without: they may be had again from the segments' results.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <viewshed/plan.hpp>

#include "plans/segment_cells.hpp"

namespace itin::viewshed {

class SegmentMerge {
 public:
  enum class Cells { kKept, kLeftOut };

  /// The plan must outlive it.
  SegmentMerge(const Plan& plan, Cells cells);
  SegmentMerge(const SegmentMerge&) = delete;
  SegmentMerge& operator=(const SegmentMerge&) = delete;

  /// These are as Merge has them.
  void add(std::size_t segment, const Result& part);
  std::vector<std::size_t> missing() const;
  Result take();

 private:
  const Plan& plan_;
  std::vector<bool> added_;
  Result result_;
  std::optional<SegmentCells> cells_;  ///< nothing: left out
};

}  // namespace itin::viewshed
