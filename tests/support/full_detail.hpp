// Viewsheds of the full surface, whatever detail a request has.
#pragma once

#include <viewshed/viewshed.hpp>

namespace itin::test {

inline viewshed::ViewshedWithSurface compute_at_full_detail(const Store& store, viewshed::Request request,
                                                            const viewshed::ComputeOptions& options,
                                                            Progress& progress) {
  request.detail = Detail::tolerance(0);
  return compute_with_surface(store, request, options, progress);
}

}  // namespace itin::test
