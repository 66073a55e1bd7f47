#include <cmath>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

void TurbineSize::complete() {
  if (!tip) {
    if (!hub || !rotor) throw InputError("it has neither tip_height nor both hub_height and rotor_diameter");
    tip = *hub + *rotor / 2;
  } else if (hub && *hub > *tip) {
    throw InputError(fmt::format("its hub_height {:g} lies above its tip_height {:g}", *hub, *tip));
  } else if (hub && !rotor && *tip > *hub) {
    rotor = 2 * (*tip - *hub);
  } else if (!hub && rotor) {
    hub = *tip - *rotor / 2;
  }
  if (hub && *hub <= 0)
    throw InputError("its rotor_diameter is more than twice its tip_height: the hub would lie below the ground");
  if (hub && rotor && *rotor / 2 > *hub)
    throw InputError(fmt::format("its blades would reach {:g} m below the ground: hub {:g}, rotor {:g}",
                                 *rotor / 2 - *hub, *hub, *rotor));
  if (hub && rotor && std::abs(*hub + *rotor / 2 - *tip) > 1)
    throw InputError(
        fmt::format("its heights contradict each other: hub {:g} and half the rotor {:g} are not the tip {:g}", *hub,
                    *rotor / 2, *tip));
}

}  // namespace itin::viewshed
