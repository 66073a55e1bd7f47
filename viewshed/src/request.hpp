// What a Request means: its checks, and the cells it asks for.
#pragma once

#include <itin/window.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// Throws InputError for everything that is wrong whatever the surface.
void validate(const Request& request);

/// The cells to decide, on a surface that covers `coverage`: as given; or aligned, over the part of the coverage within
/// the radius of an observer. Throws InputError if there is none.
RasterGrid cells_of(const Request& request, const Box& coverage);

/// The region that holds every sight line of the request.
Window window_of(const Request& request);

}  // namespace itin::viewshed
