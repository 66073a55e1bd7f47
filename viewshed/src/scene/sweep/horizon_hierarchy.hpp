// Bounds below which lines up to an axis are hidden, and above which none is, in all directions of a quadrant and up to
// distances that double, so that far away sectors need not be looked along from the axis.
//
// Nearer by, a sector one bin wide at some distance spans hardly more lines of bins than a sector that is one bin wide
// there. So a fan keeps, for every distance, sectors one to two bins wide at their ends. Each is looked along only from
// where the wider sector of half the distance ends, so that every slab is looked at about twice. The fan remembers what
// it knew at eighths of each of these distances.
#pragma once

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <itin/progress.hpp>

#include "scene/sweep/sector_profile.hpp"

namespace itin::viewshed {

class HorizonHierarchy {
 public:
  /// Promises that only lines within these slopes that begin up to this slab will be asked about; none if `from`
  /// exceeds `to`.
  void narrow(double from, double to, std::size_t slab = std::numeric_limits<std::size_t>::max()) {
    slopes_ = {from, to};
    farthest_ = from <= to ? slab : 0;
  }

  /// Looks along the sectors up to a slab, if it has not come that far yet. Memory: at most 1280 bytes per slab. Uses
  /// all threads. Throws Cancelled, after which the hierarchy is of no more use.
  void advance(const Quadrant& quadrant, const Sector::Axis& axis, std::size_t slab,
               const Progress& progress = NoProgress());

  /// The bound known by now for lines within slopes [from, to] that begin in slab `nearest`, which is the bound of the
  /// farthest slab up to there.
  Sector::Horizon known(double from, double to, std::size_t nearest) const;

 private:
  /// Sectors of equal slopes from -1 to 1, looked along up to where slab `slab` begins.
  struct Ring {
    std::size_t slab = 0;
    std::vector<float> below, above;  ///< by sector: lines are hidden below, clear above; rounded away from each other
    Sector::Horizon known(double from, double to) const;
  };
  void widen();
  std::pair<std::size_t, std::size_t> sectors() const;

  std::pair<double, double> slopes_{-1, 1};
  std::size_t farthest_ = std::numeric_limits<std::size_t>::max();  ///< slab
  std::vector<Ring> rings_;                                         ///< complete ones
  Ring front_;                                                      ///< on its way to be the next
  std::size_t widest_ = 0;  ///< slabs: up to there the front's sectors are narrow enough
};

}  // namespace itin::viewshed
