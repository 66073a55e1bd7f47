#include "options/turbine_size.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>

#include "program/field_names.hpp"
#include "program/values.hpp"

namespace itin::cli {

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

viewshed::TurbineSize TurbineSizeOptions::completed() const {
  viewshed::TurbineSize size = size_;
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
