#include "plans/segment_merge.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "modes/mode_values.hpp"
#include "plan/planned_result.hpp"

namespace itin::viewshed {

SegmentMerge::SegmentMerge(const Plan& plan, Cells cells) : plan_(plan), added_(plan.segments().size()) {
  result_.request = plan.request();
  result_.grid = plan.grid();
  add_certainty(plan, result_);
  result_.ground_m.resize(plan.request().observers.size());
  result_.values = values_outside(plan.request(), 0);
  if (cells == Cells::kKept) cells_.emplace(result_);
}

void SegmentMerge::add(std::size_t number, const Result& part) {
  const Segment& segment = plan_.segments().at(number);
  if (part.grid != plan_.grid().part(segment.north_west, segment.columns, segment.rows))
    throw InputError(fmt::format("a result of other cells than those of segment {}", number));
  if (added_[number]) return;
  added_[number] = true;
  if (cells_) cells_->add(segment, part, segment.north_west);
  for (std::size_t i = 0; i < segment.observers.size(); ++i) result_.ground_m[segment.observers[i]] = part.ground_m[i];
  for (const std::string& warning : part.warnings)
    if (std::find(result_.warnings.begin(), result_.warnings.end(), warning) == result_.warnings.end())
      result_.warnings.push_back(warning);
  result_.crosses_voids = result_.crosses_voids || part.crosses_voids;
  result_.theme_names = part.theme_names;
  result_.cells += part.cells;
  result_.statistics += part.statistics;
}

std::vector<std::size_t> SegmentMerge::missing() const {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < added_.size(); ++i)
    if (!added_[i]) numbers.push_back(i);
  return numbers;
}

Result SegmentMerge::take() {
  const std::vector<std::size_t> left = missing();
  if (!left.empty())
    throw InputError(fmt::format("{} segments are missing, segment {} first", left.size(), left.front()));
  result_.cells.outside = result_.grid.cell_count() - result_.cells.in_view();
  if (cells_) cells_->finish();
  return std::move(result_);
}

}  // namespace itin::viewshed
