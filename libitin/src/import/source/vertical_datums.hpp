// The vertical datums that the heights of a store and of its new sources refer to.
#pragma once

#include <string>

#include <itin/store.hpp>

#include "gdal/crs.hpp"

namespace itin {

/// Checks that elevations share one datum: those on different datums differ by metres, which no CRS of a store would
/// show. Datums that are not stated are trusted, but not to be the ellipsoid, which no map has its heights from.
class VerticalDatums {
 public:
  VerticalDatums() = default;
  /// Begins with the datums of a store's sources that have elevations.
  explicit VerticalDatums(const StoreMetadata& store);

  /// Adds a datum. Throws InputError, which begins with `place` and names `allow_mixed_vertical`, where another datum
  /// was added before.
  void add(const Crs& crs, const std::string& place);

  /// Tells that heights above the ellipsoid meet heights whose datum is not stated; empty where they do not, or did so
  /// in the store before.
  std::string warning() const;

 private:
  std::string datum_, place_, unstated_;  ///< the datum, the first place of it, and the first place of none
  bool told_ = false;
};

}  // namespace itin
