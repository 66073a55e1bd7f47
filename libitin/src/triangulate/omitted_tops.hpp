// The features that a query leaves out, as the store has them: by their tops, which are their vertices off the outline.
//
//   const OmittedTops tops({{theme, ids, boxes}});
//   const auto ground = tops.ground(store, selection);   // what takes their place in this selection
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/store.hpp>
#include <itin/tin.hpp>

#include "triangulate/apex/selection.hpp"
#include "triangulate/ground_beneath.hpp"

namespace itin {

/// The tops of one theme's features.
struct TopsOfTheme {
  std::uint16_t theme = 0;         ///< the theme's number, from 1
  std::vector<VertexId> vertices;  ///< ascending
  std::vector<Box> boxes;          ///< about the tops of each feature, metres
};

/// The tops of features of one store. Safe for concurrent use.
class OmittedTops {
 public:
  explicit OmittedTops(std::vector<TopsOfTheme> themes) : themes_(std::move(themes)) {}

  const std::vector<TopsOfTheme>& themes() const { return themes_; }
  /// Returns the ground in the place of the features, which depends on the selection alone. It is found once for each
  /// selection, and kept. Throws CorruptStore, FileError, Cancelled.
  std::shared_ptr<const GroundBeneath> ground(const Store& store, const Selection& selection) const;

 private:
  std::shared_ptr<const GroundBeneath> kept(const Selection& selection) const;

  std::vector<TopsOfTheme> themes_;
  mutable std::mutex mutex_;
  mutable std::vector<std::pair<Selection, std::shared_ptr<const GroundBeneath>>> grounds_;
};

}  // namespace itin
