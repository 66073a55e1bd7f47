// The surface along a path at one or more levels of detail, and its files: tables, documents, lines and charts.
//
//   const profile::PathProfiles along =
//       profile::profiles_along(store, {.corners = {{310375, 183525}, {322300, 190000}}}, progress);
//   for (const char* file : {"ridge.csv", "ridge.geojson", "ridge.svg"}) profile::write_profiles(along, file);
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <itin/cross_section.hpp>
#include <itin/detail.hpp>
#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>
#include <profile/foliage.hpp>
#include <profile/profile.hpp>

namespace itin::profile {

/// The surface at one detail along a line.
struct SurfaceProfile {
  Detail detail;
  std::string name;  ///< "tolerance 2 m"
  Profile profile;
  std::optional<PathFoliage> foliage = {};  ///< where it was asked for
};

struct PathQuery {
  std::vector<Point2> corners = {};                      ///< in the store's CRS, at least two
  std::vector<Detail> details = {Detail::tolerance(0)};  ///< one for each profile, at least one
  std::vector<std::string> names = {};                   ///< what the profiles are called; empty: by their tolerance
  ThemeChoice themes = ThemeChoice::none();              ///< raised features on the surface
  bool with_ground = true;                               ///< whether charts and text show the ground under features
  std::optional<Foliage> foliage = {};                   ///< tells the foliage along the path by these leaf areas
};

struct PathProfiles {
  PathQuery query;
  std::vector<SurfaceProfile> profiles;  ///< one per detail; no points where the path lies outside the data
  Profile ground;                        ///< the first profile without raised features; no points where it has none
  RetrievalStatistics statistics;
  std::uint64_t triangles = 0;  ///< crossed by the path
  std::string store;            ///< the store's path
  StoreMetadata metadata;
};

/// Follows a path. Throws InputError for a path or a query without what it needs, for themes that the store does not
/// have and for foliage as through_foliage() does, CorruptStore, Cancelled.
PathProfiles profiles_along(const Store& store, const PathQuery& query, Progress& progress);

/// The JSON document that `itin profile --json` prints, without the call and its outputs. `surface` in it is the
/// surface of the first profile, with these themes. Throws InputError where there is no profile.
std::string json_of(const StoreMetadata& metadata, const ThemeChoice& themes,
                    const std::vector<SurfaceProfile>& profiles);

struct ProfileFileOptions {
  std::string title = {};  ///< the title of charts; empty: where the path begins and ends
  std::string json = {};   ///< the text of .json; empty: what json_of() returns
  bool overwrite = false;
};

/// Writes the profiles as the ending of `path` says: .csv, .json, .geojson, text for other programs (.txt), a chart
/// (.svg, .pdf, .png). Throws what require_profile_format() throws; InputError for a .txt of several profiles or of one
/// with gaps, and for a .geojson in a CRS without an authority's code; FileError.
void write_profiles(const PathProfiles& profiles, const std::string& path, const ProfileFileOptions& options = {});

/// Throws InputError for any other ending than write_profiles() knows.
void require_profile_format(const std::string& path);
/// Throws InputError for a .geojson in a CRS without an authority's code.
void require_profile_crs(const std::string& path, const std::string& crs_wkt);
/// Throws InputError where the profiles cannot be written as a file of this ending.
void require_profile_output(const PathProfiles& profiles, const std::string& path);

}  // namespace itin::profile
