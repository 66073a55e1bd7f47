// A profile: the ground along a line, in the form that everything about lines of sight uses.
//
//   const profile::Profile line =
//       profile::from_section(cross_section(store, {310375, 183525}, {322300, 190000}, Detail::tolerance(0)));
//   if (const auto half_way = profile::height_at(line, line.length_m / 2)) std::cout << *half_way << " m\n";
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <itin/cross_section.hpp>
#include <itin/theme.hpp>

namespace itin {
struct StoreMetadata;
}

namespace itin::profile {

struct ProfilePoint {
  double distance_m = 0;
  double x = 0;
  double y = 0;
  double ground_m = 0;        ///< elevation of the surface
  double clutter_m = 0;       ///< on top of the ground, for diffraction only
  std::uint16_t theme = 0;    ///< the theme of the feature around the point, as in Breakpoint; 0: terrain
  std::int64_t feature = -1;  ///< the feature around the point; -1: none
};

/// A profile, its points in order of distance; two points at one distance are a vertical face. Between points the
/// ground is straight, except in the gaps, where there is none. A profile read from a file may have no positions: then
/// x = y = 0.
struct Profile {
  std::vector<ProfilePoint> points;
  std::vector<std::pair<double, double>> gaps;  ///< metres from, to; in order
  double length_m = 0;
  bool one_place = false;  ///< the ends are nearer to each other than a step of the store's grid

  /// Whether the profile has a length, so that something lies between the ends.
  bool has_length() const { return length_m > 0 && !one_place; }
  double gap_length_m() const;
  /// Whether the ground is continuous from point i to point i + 1.
  bool joined(std::size_t i) const;
  /// The theme of the feature between point i and point i + 1.
  std::uint16_t theme_between(std::size_t i) const;
};

/// A stretch of one raised theme, from point `first` to point `last`.
struct FeatureRun {
  std::size_t first = 0, last = 0;
  std::uint16_t theme = 0;
};
/// The runs in order; features that merely touch the line are left out.
std::vector<FeatureRun> feature_runs(const Profile& profile);

/// Elevations of what the two ends of a line stand on.
struct EndGrounds {
  double from_m = 0;
  double to_m = 0;
};
/// The elevations of the profile's own ends. Throws InputError where it has no points.
EndGrounds ends_of(const Profile& profile);
/// The profile's height at a distance, the greater one at a vertical face; nothing in a gap or beyond the points.
/// O(log n).
std::optional<double> height_at(const Profile& profile, double distance_m);
/// Whether there is ground under both ends.
bool has_ground_at_ends(const Profile& profile);

Profile from_section(const CrossSection& section);

/// The names of a store's themes by ProfilePoint::theme; 0 is the terrain.
std::vector<std::string> theme_names(const StoreMetadata& metadata);

/// Reads a profile from others: `d_km,h_m[,clutter_m]`, one row per point, a header optional. A header may name d_m for
/// distances in metres. Rows of four columns are those that `itin los --report FILE.txt` writes: the last tells what
/// stands there. Distances ascend (two equal ones are a vertical face) and begin anywhere: the first is the profile's
/// origin. Where no header states their unit, distances that reach 1,000 or more from the first are metres; a line in
/// `warnings` says so. Throws InputError, naming `name` and the line, for anything else, for numbers that are not
/// finite, negative clutter, heights beyond 1,000 km or that customarily mark missing data, distances that are all the
/// same or too long for any sight, and fewer than two rows.
Profile read_profile_csv(std::istream& text, const std::string& name, std::vector<std::string>& warnings);
/// Reads such a profile from a file. Throws FileError where it cannot be read.
Profile read_profile_csv(const std::string& path, std::vector<std::string>& warnings);

/// The profile as seen from the other end. Exact for distances that are multiples of 2^-30 m, as the distances of a
/// CrossSection are.
Profile reversed(const Profile& profile);

}  // namespace itin::profile
