// A profile as plain text for other programs of link planning.
//
// There is one line for each point, in order of distance, with four columns, tabs between them and no header:
//
//   1.250000	231.40	12.00	T      distance km, ground m, height of what stands there m, its kind
//
// The ground is the one without raised features. The kind is T for vegetation, B for anything else that stands there, N
// for nothing. Distances ascend strictly: at a vertical face the higher side is kept. Pathloss converts text files of
// distances and elevations (its manual, Terrain Data), and programs for P.452 and P.530 read such columns. Nobody has
// tried which of these programs take the third and fourth columns as they stand here.
#pragma once

#include <string>
#include <vector>

#include <itin/theme.hpp>
#include <profile/profile.hpp>

namespace itin::profile {

/// Writes a profile. `ground` is the line without raised features; it has no points where nothing stands on it. `kinds`
/// are the kinds of the surface's themes, by ProfilePoint::theme - 1; a theme beyond them is no vegetation.
/// Precondition: what require_profile_text() requires.
std::string profile_text(const Profile& surface, const Profile& ground, const std::vector<ThemeKind>& kinds);

/// Throws InputError, which begins with `name`, for a profile with gaps, as such text cannot tell gaps from level
/// ground.
void require_profile_text(const Profile& surface, const std::string& name);

}  // namespace itin::profile
