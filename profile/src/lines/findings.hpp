// Judges a ray over a profile, for one line and for many.
#pragma once

#include <string>
#include <vector>

#include <profile/los.hpp>

namespace itin::profile {

/// Throws InputError where there is no ground at an end, for a negative height, and for a criterion that asks for a
/// part of the Fresnel zone without a frequency.
void require_valid(const Profile& profile, const LosQuery& query, const Profile& ground);

/// Returns an effective Earth with this factor and the radius of `earth`.
Earth with_factor(double k, const Earth& earth);

struct NamedRequirement {
  std::string name;
  double k = 0;  ///< effective Earth factor; infinity without curvature
  Requirement requirement;
};
/// The requirements: a free line of sight, 0.6 F1 where there is a frequency, and each criterion.
std::vector<NamedRequirement> requirements_of(const LosQuery& query, double length_m);

/// A ray, and the profile that it passes over.
struct Sight {
  const Profile& profile;
  Antennas antennas;
  EndGrounds stands_on;
};
/// The elevations of antennas at the query's heights.
Antennas antennas_on(const EndGrounds& stands_on, const LosQuery& query);
/// Finds all but obstructions and required heights. O(n) for each criterion.
LineFindings findings(const Sight& sight, const LosQuery& query);
/// Adds the obstructions. O(n).
void add_obstructions(const Sight& sight, const LosQuery& query, LineFindings& found);
/// Adds the required heights, without curves. O(n) for each of them.
void add_required_heights(const Sight& sight, const LosQuery& query, LineFindings& found);

}  // namespace itin::profile
