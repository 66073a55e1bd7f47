// The vertical datums that the heights of a store and of its new sources refer to.
#pragma once

#include <string>

#include <itin/store.hpp>

#include "gdal/crs.hpp"

namespace itin {

/// Checks that heights share one datum: heights on different datums differ by metres, which no CRS of a store would
/// show. Unknown datums are trusted.
class VerticalDatums {
 public:
  VerticalDatums() = default;
  /// Begins with the datums of a store's sources.
  explicit VerticalDatums(const StoreMetadata& store);

  /// Adds a datum. Throws InputError, which begins with `place` and names `allow_mixed_vertical`, where another datum
  /// was added before.
  void add(const Crs& crs, const std::string& place);

 private:
  std::string datum_, place_;
};

}  // namespace itin
