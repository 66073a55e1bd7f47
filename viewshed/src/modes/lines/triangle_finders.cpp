#include "modes/lines/triangle_finders.hpp"

namespace itin::viewshed {

std::shared_ptr<const HeightPyramid> TriangleFinders::pyramid(const Progress& progress) const {
  const std::lock_guard lock(pyramid_mutex_);
  if (pyramid_) return pyramid_;
  // A thread that waits for the loops of a limit of its own takes up no other work meanwhile, which might wait for this
  // very pyramid.
  const ThreadLimit own(thread_count());
  pyramid_ = std::make_shared<const HeightPyramid>(tin_, progress);
  return pyramid_;
}

std::shared_ptr<const SurfacePieces> TriangleFinders::pieces(const Progress& progress) const {
  const std::lock_guard lock(pieces_mutex_);
  if (!pieces_) pieces_ = std::make_shared<const SurfacePieces>(pyramid(progress));
  return pieces_;
}

}  // namespace itin::viewshed
