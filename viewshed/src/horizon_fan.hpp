// What hides lines up to an axis, in all directions of a quadrant and up to distances that double, so that far away
// sectors need not be looked along from the axis.
//
// A sector one bin wide at some distance spans hardly more lines of bins nearer by than one that is one bin wide there.
// So a fan knows, for every distance, sectors about a bin wide at their ends, each looked along from where the wider
// one of half the distance ends: every slab is looked at about twice.
#pragma once

#include <cstddef>
#include <vector>

#include "sector_profile.hpp"

namespace itin::viewshed {

class HorizonFan {
 public:
  /// About the quadrant's slabs before `slabs`. Memory: at most 64 bytes a slab. Uses all threads.
  HorizonFan(const Quadrant& quadrant, const Sector::Axis& axis, std::size_t slabs);

  /// What is known for lines within slopes [from, to] that begin in slab `nearest`: of the farthest slab up to there.
  Sector::Hidden known(double from, double to, std::size_t nearest) const;

 private:
  /// Sectors of equal slopes from -1 to 1, which end where slab `slab` begins.
  struct Ring {
    std::size_t slab;
    std::vector<float> below;  ///< a sector, rounded down
  };
  std::vector<Ring> rings_;
};

}  // namespace itin::viewshed
