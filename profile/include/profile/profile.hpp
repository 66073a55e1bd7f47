// A profile: the ground along a line, as everything about lines of sight takes it.
//
//   const Profile profile = from_section(cross_section(store, a, b, detail));
//   const Sight sight = line_of_sight(profile, {h1, h2}, earth);   // profile/sight.hpp
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <itin/cross_section.hpp>

namespace itin::profile {

struct ProfilePoint {
  double distance_m = 0;
  double x = 0;
  double y = 0;
  double ground_m = 0;        ///< elevation of the surface
  double clutter_m = 0;       ///< on top of it, for diffraction only
  std::uint16_t theme = 0;    ///< of the feature that it is within, as in Breakpoint; 0: terrain
  std::int64_t feature = -1;  ///< none
};

/// In order of distance; two points at one distance are a vertical face. Between points the ground is straight, except
/// in the gaps, where there is none. Not every profile has positions: one read from a file has x = y = 0.
struct Profile {
  std::vector<ProfilePoint> points;
  std::vector<std::pair<double, double>> gaps;  ///< metres from, to; in order
  double length_m = 0;
  bool one_place = false;  ///< the ends are, as itin/same_place.hpp has it

  /// Whether anything lies between the ends.
  bool has_length() const { return length_m > 0 && !one_place; }
  /// Whether the ground is continuous from point i to point i + 1.
  bool joined(std::size_t i) const;
  /// The theme of what is between point i and point i + 1.
  std::uint16_t theme_between(std::size_t i) const;
};

/// A stretch of one standing theme, from point `first` to point `last`.
struct FeatureRun {
  std::size_t first = 0, last = 0;
  std::uint16_t theme = 0;
};
/// In order; what merely touches the line is left out.
std::vector<FeatureRun> feature_runs(const Profile& profile);

/// Elevations of what the two ends of a line stand on.
struct EndGrounds {
  double from_m = 0;
  double to_m = 0;
};
/// The profile's own ends. Precondition: it has points.
EndGrounds ends_of(const Profile& profile);
/// The profile's height at a distance, the greater one at a vertical face; nothing in a gap. O(log n).
std::optional<double> height_at(const Profile& profile, double distance_m);
/// Whether there is ground under both ends.
bool has_ground_at_ends(const Profile& profile);

Profile from_section(const CrossSection& section);

/// The same seen from the other end. Exact for distances that are multiples of 2^-30 m, as a CrossSection's are.
Profile reversed(const Profile& profile);

}  // namespace itin::profile
