// The height mode: how high a target in a cell must be for some observer to see it.
#pragma once

#include <vector>

#include "eye.hpp"
#include "least_height.hpp"
#include "observation.hpp"

namespace itin::viewshed {

class LeastHeightObservation final : public Observation {
 public:
  /// Of one tile; `resolution` is metres a grid unit. All must outlive it.
  LeastHeightObservation(const LeastHeights& heights, const std::vector<Eye>& eyes, double resolution);

  bool in_view(const Eye& eye, const Look& look) const override;
  bool open(const Look& look) const override;
  /// Lines end on the ground.
  double target(const Eye&, double ground) const override { return ground; }
  void judge(const LookPacket& packet, const Scene& scene, Occluder& occluder) override;

 private:
  void keep(const Look& look) override;
  void store_row(std::size_t cell, std::size_t columns, std::size_t place, Result& result) const override;

  /// What decides about one line.
  struct Bounds {
    double lower = 0;  ///< of the end, grid units
    double upper = 0;
  };
  Bounds bounds(const Look& look, double ground) const;
  void settle(const Look& look, const SightLines& lines, unsigned i, double least, const Scene& scene);

  const LeastHeights& heights_;
  const std::vector<Eye>& eyes_;
  double resolution_;
  LeastHeights::Memory memory_;
  TileValues<double> least_;  ///< metres above the ground; infinity where no height is seen
};

}  // namespace itin::viewshed
