// Two surfaces that enclose the full one, and how low and how high they are within the bins of a box. Used by
// block_judge.hpp.
#pragma once

#include <memory>

#include <itin/raster.hpp>

#include "bounds/envelope_bounds.hpp"
#include "bounds/triangle_bins.hpp"
#include "judge/target_rises.hpp"
#include "request/eye.hpp"
#include "window/envelope.hpp"

namespace itin::viewshed {

class BoundedEnvelope {
 public:
  /// `tiles` are the tiles of the cells; `rises` tells how far targets rise above the bare surface. Both must outlive
  /// this object. Bounds nothing yet.
  BoundedEnvelope(Envelope envelope, const RasterGrid& tiles, const TargetRises& rises);

  /// Bounds the ground within a box, metres, and no other. Takes about 16 bytes and 30 ns per bin, for two million bins
  /// at most, and nothing where that box has been bounded before.
  void bound(const Box& box);
  /// Bounds the ground that may be in an eye's view.
  void bound_for(const Eye& eye);

  const Envelope& envelope() const { return envelope_; }
  /// The triangles by tile of the cells.
  const TriangleBins& triangles() const { return triangles_; }
  /// Precondition: bound() has been called.
  const EnvelopeBounds& bounds() const { return *bounds_; }
  const TargetRises& rises() const { return rises_; }

 private:
  Envelope envelope_;
  TriangleBins triangles_;
  const TargetRises& rises_;
  std::unique_ptr<const EnvelopeBounds> bounds_;
  Box box_;
};

}  // namespace itin::viewshed
