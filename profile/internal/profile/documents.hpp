// Profiles, lines of sight and links as JSON documents, with names that stay the same from release to release.
#pragma once

#include <vector>

#include <itin/document.hpp>
#include <profile/links.hpp>
#include <profile/los.hpp>
#include <profile/path_profiles.hpp>
#include <profile/profile.hpp>

namespace itin::profile {

/// The document of profiles: `crs`, `surface`, `length_m` and `gaps` of the first profile, and `profiles`.
Document profile_document(const StoreMetadata& metadata, const ThemeChoice& themes,
                          const std::vector<SurfaceProfile>& profiles);
Document gaps_document(const Profile& profile);

/// The document of a report: `crs`, `refraction`, `from`, `to`, `magnetic_north`, `distance_m`, `geodesic_distance_m`,
/// `verdict`, `known_verdict`, `clearance_m`, `critical`, `tightest`, `obstructions`, `criteria`, `required_heights`;
/// these findings again in `bare` for the ground without its clutter; `cover`, `radio`, `visible_height`, `gaps`,
/// `gap_m`. Positions are null in a profile without any.
Document los_document(const LosReport& report);
/// Makes the same document with `surface`, `sources` and `statistics` in addition.
Document los_document(const StoreMetadata& metadata, const StoreLine& line, const LosReport& report);

/// The document of links: `crs`, `surface`, `refraction`, and in `links` the number of links by verdict.
Document links_document(const LinkSurvey& survey);

}  // namespace itin::profile
