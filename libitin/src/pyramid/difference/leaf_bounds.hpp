// How far each level of a pyramid differs from the full surface, leaf by leaf.
#pragma once

#include <cstdint>
#include <vector>

#include "pyramid/difference/overlay.hpp"

namespace itin {

/// The bounds of every level in every leaf of the working index: T_k + lo <= T_0 <= T_k + hi over the leaf.
class LeafBounds {
 public:
  LeafBounds(std::size_t leaves, int levels) : levels_(levels), bounds_(leaves * static_cast<std::size_t>(levels)) {}
  DifferenceRange& at(std::uint32_t leaf, int level) { return bounds_[std::size_t{leaf} * levels_ + level]; }
  const DifferenceRange& at(std::uint32_t leaf, int level) const {
    return bounds_[std::size_t{leaf} * levels_ + level];
  }

 private:
  int levels_;
  std::vector<DifferenceRange> bounds_;
};

}  // namespace itin
