// Interprets a Request: its checks, and the cells it asks for.
#pragma once

#include <string>
#include <vector>

#include <itin/store.hpp>
#include <viewshed/request.hpp>

namespace itin::viewshed {

/// How high above the eye a target may stand in height mode, metres; ground that hides it there hides everything.
inline constexpr double kSky = 1e7;

/// Throws InputError for everything that is wrong whatever the surface.
void validate(const Request& request);

/// Throws InputError for a request that certificates do not answer.
void validate_certified(const Request& request);

/// Tells whether a theme that stands on the ground is chosen. Certificates know nothing of what stands there: only
/// level 0 does.
bool has_raised_features(const Store& store, const Request& request);
/// Whether rays decide the request's lines to cells.
bool casts_rays(const Request& request);
/// Whether the request's mode asks more of the surface's triangles than sight lines.
bool needs_triangles(const Request& request);
/// Whether the request's mode asks about the ground under raised features, too, all along its lines.
bool needs_bare_lines(const Request& request);
/// An antenna that has what this one has, and otherwise what that of all has.
profile::AimedAntenna completed(const profile::AimedAntenna& own, const profile::AimedAntenna& of_all);
/// The link budget of an observer, with its own antenna.
profile::BudgetQuery budget_of(const Request& request, const Observer& observer);

/// Throws InputError for a link budget that is none of an area: without a power, with multipath, or with an antenna at
/// its first end that points nowhere.
void validate_budget_of_area(const profile::BudgetQuery& budget);
/// Whether the request's mode studies each line as a radio path.
bool studies_paths(const Request& request);
/// Whether the request's levels come with outages by rain.
bool tells_outage(const Request& request);

/// How far the observer looks; nothing where it looks as far as there is ground.
std::optional<double> radius_of(const Request& request, const Observer& observer);
/// Whether every observer has a radius.
bool all_bounded(const Request& request);

/// Whether the angles between which an observer looks have bounds.
bool bounds_elevations(const Request& request);

/// Returns the cells to decide: the given ones; or aligned ones over the extent of all data, or, where every observer
/// has a radius, over the part of it about the discs within the radii. So they do not depend on what is read of the
/// data. Throws InputError if there are none.
RasterGrid cells_of(const Request& request, const Box& extent);

/// The name of the rule in options and metadata.
std::string nodata_text(NoData rule);

}  // namespace itin::viewshed
