// Two surfaces that enclose the full one, and how low and how high they are within the bins of a box: what
// block_judge.hpp judges by.
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
  /// `tiles` are those of the cells; targets on these rise above the bare surface. Both must outlive it. Bounds nothing
  /// yet.
  BoundedEnvelope(Envelope envelope, const RasterGrid& tiles, const TargetRises& rises);

  /// Bounds the ground within a box, metres, and no other: about 16 bytes and 30 ns per bin, of which there are two
  /// million at most. Costs nothing where that box has been bounded before.
  void bound(const Box& box);
  /// The ground that may be in an eye's view.
  void bound_for(const Eye& eye);

  const Envelope& envelope() const { return envelope_; }
  /// By tile of the cells.
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
