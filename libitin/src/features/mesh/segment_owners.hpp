// Who owns the lines of features while they are made planar: a feature's feet, its eaves and so on. Feet come first, so
// that their heights count, then eaves and creases.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <itin/sort_unique.hpp>

#include "features/mesh/feature_group.hpp"
#include "features/plan/planar.hpp"

namespace itin {

class SegmentOwners {
 public:
  using Owner = std::pair<SegmentClass, std::uint32_t>;  ///< the class and the feature

  SegmentOwners() = default;
  explicit SegmentOwners(const std::vector<PlacedSegment>& segments) {
    for (const PlacedSegment& s : segments) owners_.emplace_back(s.kind, s.feature);
    sort_unique(owners_);
  }

  std::uint32_t count() const { return static_cast<std::uint32_t>(owners_.size()); }
  const Owner& operator[](std::uint32_t number) const { return owners_[number]; }
  /// The segments given, each with its owner's number.
  std::vector<OwnedSegment> owned(const std::vector<PlacedSegment>& segments) const {
    std::vector<OwnedSegment> result;
    for (const PlacedSegment& s : segments) {
      const auto at = std::lower_bound(owners_.begin(), owners_.end(), Owner{s.kind, s.feature});
      result.push_back({s.a, s.b, static_cast<std::uint32_t>(at - owners_.begin())});
    }
    return result;
  }

 private:
  std::vector<Owner> owners_;
};

/// Tells whether an earlier owner has edge i as well: edges are in order, and the first owner has what several share.
inline bool of_later_owner(const std::vector<PlanarEdge>& edges, std::size_t i) {
  return i > 0 && edges[i - 1].from == edges[i].from && edges[i - 1].to == edges[i].to;
}

}  // namespace itin
