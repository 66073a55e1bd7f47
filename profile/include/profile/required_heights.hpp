// Finds how high antennas must stand: one end alone, both equally, and one height against the other.
//
//   const profile::Requirement six_tenths{Earth(), 0.6, 0.03997};  // part of F1, at 7.5 GHz
//   const profile::RequiredHeights heights = profile::required_heights(line, {10, 15}, six_tenths);
//   // The first end's height, the second one's staying at 15 m.
//   if (heights.from_alone_m) std::cout << *heights.from_alone_m << " m\n";
//
// A requirement asks that everywhere between the ends the ray stands `fraction` first Fresnel radii above the ground,
// on an Earth of its own. Two-criterion planning after ITU-R P.530-18 section 2.2 has two requirements, of which the
// greater height rules. Heights are metres above what the ends stand on (`grounds`; without it, the profile there).
// They are least heights: at exactly this height the requirement is met.
#pragma once

#include <optional>
#include <vector>

#include <itin/earth.hpp>
#include <profile/profile.hpp>

namespace itin::profile {

struct Requirement {
  Earth earth = {};
  double fraction = 0;    ///< part of the first Fresnel radius; 0: mere line of sight
  double wavelength = 0;  ///< metres; not used when the fraction is 0
};

struct HeightPair {
  double from_m = 0;
  std::optional<double> to_m;  ///< nothing: no height of the second end makes up for from_m
};

struct RequiredHeights {
  std::optional<double> from_alone_m;  ///< nothing: no height is enough while the other end stands where it does
  std::optional<double> to_alone_m;    ///< nothing: no height is enough while the other end stands where it does
  std::optional<double> both_equal_m;  ///< nothing: ground in the way at an end itself
};

/// Heights of the two ends as planned, above their ground.
struct PlannedHeights {
  double from_m = 0;
  double to_m = 0;
};
/// Finds the required heights. Throws InputError for a profile without ground at both ends, or without length. Every
/// height is good to 1e-9 relative to the profile's range of elevations; nothing is sampled. O(n) for each height.
RequiredHeights required_heights(const Profile& profile, const PlannedHeights& planned, const Requirement& requirement,
                                 const std::optional<EndGrounds>& grounds = {});

inline constexpr int kCurvePoints = 25;
/// Returns the second end's height against the first's, at kCurvePoints heights ascending in from_m; descending in
/// to_m. Empty where `both_equal_m`, which required_heights() found, is nothing. Throws, and costs, what
/// required_heights() does.
std::vector<HeightPair> height_curve(const Profile& profile, const PlannedHeights& planned,
                                     const Requirement& requirement, const std::optional<double>& both_equal_m,
                                     const std::optional<EndGrounds>& grounds = {});

/// A tall upright object, such as a wind turbine. Its foot is on what the end stands on.
struct TallObject {
  std::optional<double> hub_m = {};  ///< above its foot, no higher than the tip; nothing: no hub
  double tip_m = 0;                  ///< above its foot
};

/// A part of an object that reaches from its foot up to some height.
struct VisiblePart {
  double visible_m = 0;  ///< length of the part that is seen, from its top down
  double fraction = 0;   ///< the visible part of its height, 0 to 1
};

/// The visible part of an object at the second end, seen from an antenna or eye at the first.
struct VisibleHeight {
  double from_m = 0;               ///< above the object's foot: anything below it is hidden
  VisiblePart tip;                 ///< up to the tip
  std::optional<VisiblePart> hub;  ///< up to the hub, where there is one
};

/// Finds the visible part. `eye_m` is above what the first end stands on. Throws InputError without ground at both
/// ends.
VisibleHeight visible_height(const Profile& profile, double eye_m, const TallObject& object, const Earth& earth,
                             const std::optional<EndGrounds>& grounds = {});

}  // namespace itin::profile
