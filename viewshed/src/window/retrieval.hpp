// Retrieves what a certified viewshed reads: the level asked for, and finer ones about the observers. Reading single
// places and the coarsest level takes little, and shows no progress of its own.
#pragma once

#include <optional>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/request.hpp>

#include "request/eye.hpp"
#include "window/envelope.hpp"

namespace itin::viewshed {

/// The height at a position, metres: of the full surface with these themes, or of another detail; nothing where there
/// is no data.
std::optional<double> height_at(const Store& store, Point2 position, const ThemeChoice& themes, Progress& progress,
                                const Detail& detail = Detail::tolerance(0));

/// Reads all that has data within the window at the coarsest level, whose outline is that of the full surface.
Tin coverage_of(const Store& store, const Window& window, Progress& progress);

/// Returns the observers' eyes on the surface of this detail under them, or on what stands on it where the request says
/// so; `ground` gets the surface's heights, metres. Throws InputError for an observer outside the data.
std::vector<Eye> eyes_on_surface(const Store& store, const Request& request, const Detail& detail,
                                 std::vector<double>& ground, Progress& progress);

/// About how many points of this level and coarser ones lie per square metre of the request's window.
double points_per_square_metre(const Store& store, int level, const Request& request);

/// The greatest radius about a position, metres, within which a level has at most about `points` points.
double radius_with(const Store& store, int level, Point2 centre, double points);

/// Returns the request for the envelope of request.detail.
EnvelopeRequest certified_request(const Store& store, const Request& request);

/// Takes this level in place of request.detail's, and encloses the surface of level `surface`. No features stand there,
/// nor are any enclosed.
EnvelopeRequest certified_request(const Store& store, const Request& request, int level, int surface = 0);

}  // namespace itin::viewshed
