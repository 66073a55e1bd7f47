// Tells of many places whether lengths are true about them.
//
//   TrueCells true_cells(meter);
//   if (!true_cells.hold(place)) leave_out(place);
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <utility>

#include <itin/geometry.hpp>

#include "gdal/scale_meter.hpp"

namespace itin {

/// Measures the scale once for each cell of 20 km, along which it hardly changes.
class TrueCells {
 public:
  /// The meter must outlive it.
  explicit TrueCells(const ScaleMeter& meter) : meter_(meter) {}

  bool hold(Point2 place) {
    const Cell cell{std::llround(std::floor(place.x / kSide)), std::llround(std::floor(place.y / kSide))};
    if (cell != last_) {
      last_ = cell;
      const auto [at, fresh] = known_.try_emplace(cell, false);
      if (fresh) at->second = is_true(cell);
      last_is_true_ = at->second;
    }
    return last_is_true_;
  }

 private:
  using Cell = std::pair<std::int64_t, std::int64_t>;
  static constexpr double kSide = 20000;

  bool is_true(const Cell& cell) const {
    const Point2 middle{(static_cast<double>(cell.first) + 0.5) * kSide,
                        (static_cast<double>(cell.second) + 0.5) * kSide};
    const auto scale = meter_.at(std::span(&middle, 1));
    return scale && scale->is_true();
  }

  const ScaleMeter& meter_;
  std::map<Cell, bool> known_;
  Cell last_{INT64_MIN, INT64_MIN};  ///< the cell of the place before
  bool last_is_true_ = false;
};

}  // namespace itin
