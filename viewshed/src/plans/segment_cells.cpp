#include "plans/segment_cells.hpp"

#include <algorithm>
#include <functional>

#include "modes/observation.hpp"

namespace itin::viewshed {

namespace {

/// Copies the cells of one segment.
class Copy {
 public:
  Copy(const Segment& segment, RasterGrid::Cell at, Result& to, BlockerTable& blockers)
      : segment_(segment), at_(at), to_(to), blockers_(blockers) {}

  void operator()(const Result& part) {
    copy(part.visible, to_.visible);
    std::visit([&]<class Values>(const Values& values) { add(values, to_.get<Values>()); }, part.values);
  }

 private:
  void add(std::monostate, std::monostate) {}
  void add(const Counts& from, Counts& to) { copy(from.count, to.count); }
  void add(const Angles& from, Angles& to) { copy(from.angle_deg, to.angle_deg); }
  void add(const LeastHeights& from, LeastHeights& to) { copy(from.height_m, to.height_m); }
  void add(const Probabilities& from, Probabilities& to) { copy(from.probability, to.probability); }
  void add(const Losses& from, Losses& to) {
    copy(from.diffraction_db, to.diffraction_db);
    copy(from.free_space_db, to.free_space_db);
  }
  void add(const Levels& from, Levels& to) {
    copy(from.level_dbm, to.level_dbm);
    copy(from.outage_minutes, to.outage_minutes);
    copy(from.observer, to.observer, [&](std::uint32_t number) { return of_all(number); });
  }
  /// The number among all observers, from 1, of one that has this number among the segment's; 0 stands for none.
  std::uint32_t of_all(std::uint32_t number) const {
    return number == 0 ? 0 : static_cast<std::uint32_t>(segment_.observers[number - 1] + 1);
  }
  void add(const NearestObservers& from, NearestObservers& to) {
    copy(from.distance_m, to.distance_m);
    copy(from.number, to.number, [&](std::uint32_t number) { return of_all(number); });
  }
  void add(const Blockers& from, Blockers& to) {
    const std::vector<std::uint32_t> numbers = blockers_.numbers_of(from.triangles);
    copy(from.feature, to.feature);
    copy(from.triangle, to.triangle,
         [&](std::uint32_t blocker) { return blocker < kMissingGround ? numbers[blocker] : blocker; });
  }
  /// Moves the observers' bits, which are others among all, too.
  void add(const ObserverSets& from, ObserverSets& to) {
    for (std::size_t i = 0; i < segment_.observers.size(); ++i) {
      const RasterBit bit = raster_bit(i), bit_of_all = raster_bit(segment_.observers[i]);
      const auto cells = static_cast<std::size_t>(segment_.columns * segment_.rows);
      const std::size_t first = bit.grid * cells, first_of_all = bit_of_all.grid * to_.grid.cell_count();
      for (std::size_t cell = 0; cell < cells; ++cell) {
        if ((from.words[first + cell] & bit.mask) == 0) continue;
        const auto n = static_cast<std::int64_t>(cell);
        const RasterGrid::Cell place{at_.column + n % segment_.columns, at_.row + n / segment_.columns};
        to.words[first_of_all + to_.grid.index(place)] |= bit_of_all.mask;
      }
    }
  }

  /// Copies the segment's values to their places. An empty list of values, as for features that were not named, changes
  /// nothing.
  template <class T, class Become = std::identity>
  void copy(const std::vector<T>& from, std::vector<T>& to, const Become& become = {}) const {
    if (from.empty()) return;
    for (std::int64_t row = 0; row < segment_.rows; ++row) {
      const auto first = from.begin() + row * segment_.columns;
      const std::size_t place = to_.grid.index({at_.column, at_.row + row});
      std::transform(first, first + segment_.columns, to.begin() + static_cast<std::ptrdiff_t>(place), become);
    }
  }

  const Segment& segment_;
  RasterGrid::Cell at_;  ///< where the segment's first cell is
  Result& to_;
  BlockerTable& blockers_;
};

}  // namespace

SegmentCells::SegmentCells(Result& to) : to_(to) {
  Observation::prepare(to_);
  if (auto* const blockers = std::get_if<Blockers>(&to_.values))
    blockers->feature.assign(to_.grid.cell_count(), kNoBlocker);
}

void SegmentCells::add(const Segment& segment, const Result& part, RasterGrid::Cell at) {
  Copy(segment, at, to_, blockers_)(part);
}

void SegmentCells::finish() {
  if (to_.request.mode == Mode::kBlocker) blockers_.give(to_);
}

}  // namespace itin::viewshed
