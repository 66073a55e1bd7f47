#include "options/radio/antenna_options.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>

#include "program/values.hpp"

namespace itin::cli {

void AntennaOptions::declare(CLI::App& app, const std::string& spacing) {
  spacing_ = spacing;
  app.add_option(spacing_, spacing_text_, "Distance between the places along a wall and on a roof (default: 1)")
      ->type_name("METRES");
  app.add_option("--reveal", reveal_text_, "How far before its wall an antenna is (default: 0.3)")->type_name("METRES");
  app.add_option("--storey", storey_text_,
                 "Antennas on walls are at multiples of this height above the ground (default: 3)")
      ->type_name("METRES");
  app.add_option("--pole", pole_text_, "Heights of antennas above the roof, the least first (default: 0,5)")
      ->type_name("H[,H...]");
}

void AntennaOptions::validate() {
  constexpr double kLeastSpacing = 0.1;
  const auto take = [](const std::string& option, const std::string& text, double& value) {
    if (!text.empty()) value = parse_number(option.c_str(), text, Range::kPositive);
  };
  take(spacing_, spacing_text_, places_.spacing);
  if (places_.spacing < kLeastSpacing) throw InputError(spacing_ + ": give 0.1 m or more");
  take("--reveal", reveal_text_, places_.reveal);
  take("--storey", storey_text_, places_.storey);
  if (!pole_text_.empty()) places_.poles = parse_heights("--pole", pole_text_, Range::kNotNegative);
}

Document AntennaOptions::parameters() const {
  return {{"spacing_m", places_.spacing},
          {"reveal_m", places_.reveal},
          {"storey_m", places_.storey},
          {"poles_m", places_.poles}};
}

}  // namespace itin::cli
