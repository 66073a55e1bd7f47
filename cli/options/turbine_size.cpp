#include "options/turbine_size.hpp"

#include <cmath>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "program/field_names.hpp"
#include "program/values.hpp"

namespace itin::cli {

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

void TurbineSizeOptions::declare(CLI::App& app, const std::string& which) {
  app.add_option("--hub-height", hub_text_, "Hub height " + which)->type_name("METRES");
  app.add_option("--rotor-diameter", rotor_text_, "Rotor diameter " + which)->type_name("METRES");
  app.add_option("--tip-height", tip_text_, "Height of the highest blade tip, " + which)->type_name("METRES");
}

void TurbineSizeOptions::validate() {
  if (!hub_text_.empty()) size_.hub = parse_height("--hub-height", hub_text_, Range::kPositive);
  if (!rotor_text_.empty()) size_.rotor = parse_height("--rotor-diameter", rotor_text_, Range::kPositive);
  if (!tip_text_.empty()) size_.tip = parse_height("--tip-height", tip_text_, Range::kPositive);
  if (size_.tip && (size_.hub || size_.rotor)) completed();
}

TurbineSize TurbineSizeOptions::completed() const {
  TurbineSize size = size_;
  try {
    size.complete();
  } catch (const InputError& error) {
    throw InputError(fmt::format(
        "--hub-height, --rotor-diameter, --tip-height: no turbine can have these, {}; leave out or correct one of them",
        in_options(error.what())));
  }
  return size;
}

Document TurbineSizeOptions::parameters() const {
  Document parameters = Document::object();
  if (size_.hub) parameters["hub_height_m"] = *size_.hub;
  if (size_.rotor) parameters["rotor_diameter_m"] = *size_.rotor;
  if (size_.tip) parameters["tip_height_m"] = *size_.tip;
  return parameters;
}

}  // namespace itin::cli
