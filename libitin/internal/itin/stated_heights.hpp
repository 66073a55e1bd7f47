// The meaning of the heights of a store's sources.
//
//   const StatedHeights heights(store.metadata());
//   for (const SourceInfo& source : store.metadata().sources)
//     if (const auto axis = heights.of(source)) std::cout << described(*axis) << '\n';
#pragma once

#include <map>
#include <optional>
#include <string>

#include <itin/height_axis.hpp>
#include <itin/store.hpp>

namespace itin {

class StatedHeights {
 public:
  /// Refers to the metadata, which must outlive it.
  explicit StatedHeights(const StoreMetadata& metadata);

  /// Returns what is known about one of these sources. Nothing where it has no heights, or its CRS is not understood
  /// here.
  std::optional<HeightAxis> of(const SourceInfo& source) const;
  /// Returns "heights above a datum that is not stated, unit: metre"; for features, whose heights may count from the
  /// ground or from a base, "heights of features, unit: metre", or "heights of features from dsm.tif"; empty where
  /// nothing is known.
  std::string text_of(const SourceInfo& source) const;

 private:
  const ThemeInfo* theme_of(const SourceInfo& source) const;

  const StoreMetadata& metadata_;
  std::map<std::string, std::optional<HeightAxis>> axes_;  ///< by CRS, as many tiles share one
};

}  // namespace itin
