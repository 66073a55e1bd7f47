// Segments of a plan: each one's viewshed, and all of them together.
#include <algorithm>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <viewshed/plan.hpp>

#include "certify/certified.hpp"
#include "exact/compute.hpp"
#include "line/cell_tiles.hpp"
#include "modes/blocker_table.hpp"
#include "modes/mode_values.hpp"
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
    if (auto* const blockers = std::get_if<Blockers>(&result_.values))
      blockers->feature.assign(plan.grid().cell_count(), kNoBlocker);
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
    copy(segment, part.visible, result_.visible);
    std::visit([&]<class Values>(const Values& values) { add(segment, values, result_.get<Values>()); }, part.values);
  }

  void add(const Segment&, std::monostate, std::monostate) {}
  void add(const Segment& segment, const Counts& from, Counts& to) { copy(segment, from.count, to.count); }
  void add(const Segment& segment, const Angles& from, Angles& to) { copy(segment, from.angle_deg, to.angle_deg); }
  void add(const Segment& segment, const LeastHeights& from, LeastHeights& to) {
    copy(segment, from.height_m, to.height_m);
  }
  void add(const Segment& segment, const Probabilities& from, Probabilities& to) {
    copy(segment, from.probability, to.probability);
  }
  void add(const Segment& segment, const Losses& from, Losses& to) {
    copy(segment, from.diffraction_db, to.diffraction_db);
    copy(segment, from.free_space_db, to.free_space_db);
  }
  void add(const Segment& segment, const Levels& from, Levels& to) {
    copy(segment, from.level_dbm, to.level_dbm);
    copy(segment, from.outage_minutes, to.outage_minutes);
    copy(segment, from.observer, to.observer, [&](std::uint32_t number) { return of_all(segment, number); });
  }
  /// The number among all observers, from 1, of one that has this number among the segment's; 0 stands for none.
  static std::uint32_t of_all(const Segment& segment, std::uint32_t number) {
    return number == 0 ? 0 : static_cast<std::uint32_t>(segment.observers[number - 1] + 1);
  }
  void add(const Segment& segment, const NearestObservers& from, NearestObservers& to) {
    copy(segment, from.distance_m, to.distance_m);
    copy(segment, from.number, to.number, [&](std::uint32_t number) { return of_all(segment, number); });
  }
  void add(const Segment& segment, const Blockers& from, Blockers& to) {
    const std::vector<std::uint32_t> numbers = blockers_.numbers_of(from.triangles);
    copy(segment, from.feature, to.feature);
    copy(segment, from.triangle, to.triangle,
         [&](std::uint32_t blocker) { return blocker < kMissingGround ? numbers[blocker] : blocker; });
  }
  /// Moves the observers' bits, which are others among all, too.
  void add(const Segment& segment, const ObserverSets& from, ObserverSets& to) {
    for (std::size_t i = 0; i < segment.observers.size(); ++i) {
      const RasterBit bit = raster_bit(i), bit_of_all = raster_bit(segment.observers[i]);
      const auto cells = static_cast<std::size_t>(segment.columns * segment.rows);
      const std::size_t first = bit.grid * cells, first_of_all = bit_of_all.grid * result_.grid.cell_count();
      for (std::size_t cell = 0; cell < cells; ++cell) {
        if ((from.words[first + cell] & bit.mask) == 0) continue;
        const auto n = static_cast<std::int64_t>(cell);
        const RasterGrid::Cell place{segment.north_west.column + n % segment.columns,
                                     segment.north_west.row + n / segment.columns};
        to.words[first_of_all + result_.grid.index(place)] |= bit_of_all.mask;
      }
    }
  }

  /// Copies the segment's values to their places. An empty list of values, as for features that were not named, changes
  /// nothing.
  template <class T, class Become = std::identity>
  void copy(const Segment& segment, const std::vector<T>& from, std::vector<T>& to, const Become& become = {}) const {
    if (from.empty()) return;
    for (std::int64_t row = 0; row < segment.rows; ++row) {
      const auto first = from.begin() + row * segment.columns;
      const std::size_t place = result_.grid.index({segment.north_west.column, segment.north_west.row + row});
      std::transform(first, first + segment.columns, to.begin() + static_cast<std::ptrdiff_t>(place), become);
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
