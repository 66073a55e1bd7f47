#include "request/eye.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/grid_units.hpp>

namespace itin::viewshed {

namespace {

constexpr const char* kElevationOverNothing =
    "there is no data there, and its elevation does not tell whether it is above ground; move it onto the data, or, "
    "where it is the sea, import with `sea_level`";

}  // namespace

void refuse(const Observer& observer, const std::string& why) {
  throw InputError(
      fmt::format("observer {} at {:.10g},{:.10g}: {}", observer.name, observer.position.x, observer.position.y, why),
      "observers");
}

Eye eye_of(const Grid& grid, const Request& request, const Observer& observer, std::optional<double> ground) {
  if (!ground)
    refuse(observer, observer.absolute ? kElevationOverNothing : "there is no data there; move it onto the data");
  if (observer.absolute && observer.height < *ground)
    refuse(observer, fmt::format("its elevation {:g} m is below the ground, {:.2f} m", observer.height, *ground));
  const double elevation = observer.absolute ? observer.height : *ground + observer.height;
  return {observer.position,
          elevation,
          {easting_in_units(grid, observer.position.x), northing_in_units(grid, observer.position.y),
           elevation / grid.resolution},
          observer.absolute,
          FieldOfView(request, observer),
          observer.target_height.value_or(request.target_height),
          request.target_absolute};
}

}  // namespace itin::viewshed
