// What finds the triangles of a Tin along lines. It is made when a study of lines first asks for it, and kept for the
// studies that follow.
//
//   const TriangleFinders finders(tin);
//   const FirstBlocker blockers(finders.pyramid(progress), earth);
#pragma once

#include <memory>
#include <mutex>

#include <itin/progress.hpp>
#include <itin/tin.hpp>

#include "bounds/height_pyramid.hpp"
#include "modes/lines/surface_pieces.hpp"

namespace itin::viewshed {

/// Safe for concurrent use: threads that need the same finder make it once.
class TriangleFinders {
 public:
  /// The Tin must outlive it, and what it returns.
  explicit TriangleFinders(const Tin& tin) : tin_(tin) {}

  const Tin& tin() const { return tin_; }
  // The first call costs what HeightPyramid and SurfacePieces cost. Where it throws Cancelled, the next one begins
  // anew.
  std::shared_ptr<const HeightPyramid> pyramid(const Progress& progress) const;
  std::shared_ptr<const SurfacePieces> pieces(const Progress& progress) const;

 private:
  const Tin& tin_;
  mutable std::mutex pyramid_mutex_, pieces_mutex_;
  mutable std::shared_ptr<const HeightPyramid> pyramid_;
  mutable std::shared_ptr<const SurfacePieces> pieces_;
};

}  // namespace itin::viewshed
