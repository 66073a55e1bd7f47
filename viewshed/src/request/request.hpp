// Interprets a Request: its checks, and the cells it asks for.
#pragma once

#include <string>
#include <vector>

#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// In height mode no target stands higher above the eye, metres; ground that hides it there hides everything.
inline constexpr double kSky = 1e7;

/// Throws InputError for everything that is wrong whatever the surface.
void validate(const Request& request);

/// Throws InputError for what certificates do not tell.
void validate_certified(const Request& request);

/// Whether a theme that stands on the ground is chosen. Certificates know nothing of it: where it does, only level 0
/// says what is there.
bool has_raised_features(const Store& store, const Request& request);
/// Whether rays decide the request's lines to cells.
bool casts_rays(const Request& request);
/// Whether the request's mode asks more of the surface's triangles than sight lines.
bool needs_triangles(const Request& request);
/// Whether the request's mode asks about the ground under raised features, too, all along its lines.
bool needs_bare_lines(const Request& request);
/// Where the observers stand, metres.
std::vector<Point2> positions_of(const Request& request);

/// How far the observer looks; nothing: as far as there is ground.
std::optional<double> radius_of(const Request& request, const Observer& observer);
/// Whether every observer has a radius.
bool all_bounded(const Request& request);

/// Whether the angles between which an observer looks have bounds.
bool bounds_elevations(const Request& request);

/// The cells to decide: as given; or aligned, over the extent of all data, or the part of it about the discs within the
/// observers' radii, where each has one. So they do not depend on what is read of the data. Throws InputError if there
/// are none.
RasterGrid cells_of(const Request& request, const Box& extent);

/// As options and metadata have it.
std::string nodata_text(NoData rule);

}  // namespace itin::viewshed
