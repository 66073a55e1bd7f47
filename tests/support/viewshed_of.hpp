// A viewshed on a Tin, without progress.
#pragma once

#include <viewshed/viewshed.hpp>

namespace itin::test {

inline viewshed::Result run(const Tin& tin, const viewshed::Request& request) {
  NoProgress progress;
  return viewshed::compute(tin, request, progress);
}

}  // namespace itin::test
