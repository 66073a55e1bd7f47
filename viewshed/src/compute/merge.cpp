// Segments of a plan: each one's viewshed, and all of them together.
#include <algorithm>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <viewshed/plan.hpp>

#include "compute/certified.hpp"
#include "compute/compute.hpp"
#include "line/cell_tiles.hpp"
#include "modes/blocker_table.hpp"
#include "modes/mode_rasters.hpp"
#include "modes/observation.hpp"
#include "plan/planned_result.hpp"

namespace itin::viewshed {

Result decide(const Store& store, const Plan& plan, std::size_t segment, Progress& progress) {
  const Request request = plan.request_of(segment);
  if (plan.certainty() == Certainty::kExact) return compute_result(store, request, plan.options(), progress);
  const CertifiedWay way = plan.decides_exactly() ? CertifiedWay::kExactly : certified_way(store, plan.request());
  return compute_certified(store, request, way, plan.options(), progress).result;
}

/// The whole result in the making.
class Merge::Rasters {
 public:
  explicit Rasters(const Plan& plan) : plan_(plan), added_(plan.segments().size()) {
    result_.request = plan.request();
    result_.grid = plan.grid();
    add_certainty(plan, result_);
    result_.ground_m.resize(plan.request().observers.size());
    Observation::prepare(result_);
    if (plan.request().mode == Mode::kBlocker) result_.blocker_feature.assign(plan.grid().cell_count(), kNoBlocker);
  }

  void add(std::size_t number, const Result& part) {
    const Segment& segment = plan_.segments().at(number);
    if (part.grid != plan_.grid().part(segment.north_west, segment.columns, segment.rows))
      throw InputError(fmt::format("a result of other cells than those of segment {}", number));
    if (added_[number]) return;
    added_[number] = true;
    add_cells(segment, part);
    for (std::size_t i = 0; i < segment.observers.size(); ++i)
      result_.ground_m[segment.observers[i]] = part.ground_m[i];
    for (const std::string& warning : part.warnings)
      if (std::find(result_.warnings.begin(), result_.warnings.end(), warning) == result_.warnings.end())
        result_.warnings.push_back(warning);
    result_.crosses_voids = result_.crosses_voids || part.crosses_voids;
    result_.theme_names = part.theme_names;
    result_.cells += part.cells;
    result_.statistics += part.statistics;
  }

  std::vector<std::size_t> missing() const {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < added_.size(); ++i)
      if (!added_[i]) numbers.push_back(i);
    return numbers;
  }

  Result take() {
    result_.cells.outside = result_.grid.cell_count() - result_.cells.in_view();
    if (result_.request.mode == Mode::kBlocker) blockers_.give(result_);
    return std::move(result_);
  }

 private:
  void add_cells(const Segment& segment, const Result& part) {
    for_each_raster_of(result_.request.mode, [&](auto raster, auto) { copy(segment, part.*raster, result_.*raster); });
    copy(segment, part.blocker_feature, result_.blocker_feature);
    // Numbers among the segment's observers and blockers become those among all.
    copy(segment, part.nearest, result_.nearest,
         [&](std::uint32_t from_1) { return from_1 == 0 ? 0 : segment.observers[from_1 - 1] + 1; });
    const std::vector<std::uint32_t> numbers = blockers_.numbers_of(part.blockers);
    copy(segment, part.blocker, result_.blocker,
         [&](std::uint32_t blocker) { return blocker < kMissingGround ? numbers[blocker] : blocker; });
    if (!part.which.empty()) add_bits(segment, part);
  }

  /// The segment's values to their places; a mode that has none of these copies none.
  template <class T, class Become = std::identity>
  void copy(const Segment& segment, const std::vector<T>& from, std::vector<T>& to, const Become& become = {}) const {
    if (from.empty()) return;
    for (std::int64_t row = 0; row < segment.rows; ++row) {
      const auto first = from.begin() + row * segment.columns;
      const std::size_t place = result_.grid.index({segment.north_west.column, segment.north_west.row + row});
      std::transform(first, first + segment.columns, to.begin() + static_cast<std::ptrdiff_t>(place), become);
    }
  }

  /// Observers have other bits in the whole than among the segment's.
  void add_bits(const Segment& segment, const Result& part) {
    for (std::size_t i = 0; i < segment.observers.size(); ++i) {
      const RasterBit from = raster_bit(i), to = raster_bit(segment.observers[i]);
      const std::size_t from_grid = from.grid * part.grid.cell_count(), to_grid = to.grid * result_.grid.cell_count();
      for (std::int64_t row = 0; row < segment.rows; ++row) {
        for (std::int64_t column = 0; column < segment.columns; ++column) {
          if ((part.which[from_grid + part.grid.index({column, row})] & from.mask) == 0) continue;
          const RasterGrid::Cell place{segment.north_west.column + column, segment.north_west.row + row};
          result_.which[to_grid + result_.grid.index(place)] |= to.mask;
        }
      }
    }
  }

  const Plan& plan_;
  std::vector<bool> added_;
  BlockerTable blockers_;
  Result result_;
};

Merge::Merge(const Plan& plan) : rasters_(std::make_unique<Rasters>(plan)) {}
Merge::~Merge() = default;

void Merge::add(std::size_t segment, const Result& result) {
  rasters_->add(segment, result);
}

std::vector<std::size_t> Merge::missing() const {
  return rasters_->missing();
}

Result Merge::take() {
  const std::vector<std::size_t> left = missing();
  if (!left.empty())
    throw InputError(fmt::format("{} segments are missing, segment {} first", left.size(), left.front()));
  return rasters_->take();
}

}  // namespace itin::viewshed
