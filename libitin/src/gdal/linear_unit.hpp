// Units of length, by their EPSG codes and by the names that files have for them.
#pragma once

#include <optional>
#include <string>

namespace itin {

struct LinearUnit {
  std::string name;
  double metres = 1;  ///< length of one unit
};

/// Returns the unit of EPSG's code, as GeoTIFF keys have it: 9002 is the foot.
std::optional<LinearUnit> linear_unit(int epsg_code);

/// Returns the unit of a name. Case, underscores, hyphens and brackets about the name do not matter: "ft",
/// "US_survey_foot", "[m]".
std::optional<LinearUnit> linear_unit(const std::string& name);

/// Returns the name of a unit of this many metres; `otherwise` where it is unknown.
std::string unit_name(double metres, const std::string& otherwise);

}  // namespace itin
