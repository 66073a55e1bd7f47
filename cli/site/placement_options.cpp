#include "site/placement_options.hpp"

#include <cmath>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/unusable_options.hpp"
#include "program/values.hpp"

namespace itin::cli {

void PlacementOptions::declare(CLI::App& app) {
  begin_group(app, "Turbines to place");
  app_ = &app;
  app.add_flag("--turbines", given_, "Place wind turbines where the demand sees least of them");
  size_options_.declare(app, "of the turbines that are placed");
  app.add_option("--minimise", minimised_text_,
                 "What is to be least: the demand that sees a tip (default) or a hub, or the visible height of every "
                 "turbine, summed over the demand")
      ->type_name("tips|hubs|height");
  app.add_option("--rotor-spacing", spacing_text_,
                 "No turbine stands within an ellipse about another: half its axes are A rotor diameters along the "
                 "wind and B across it (A alone: a circle)")
      ->type_name("A[xB]");
  app.add_option("--wind-from", wind_text_, "Where the prevailing wind comes from, degrees from grid north")
      ->type_name("BEARING");
  reads(
      app.add_option("--dwellings", dwellings, "Dwellings to keep away from: points, or polygons")->type_name("FILE"));
  app.add_option("--setback", setback_text_, "No turbine stands nearer to a dwelling")->type_name("METRES");
  app.add_option("--farm", placement_.farm, "The farm's name in turbines.csv (default: proposed)")->type_name("NAME");
}

void PlacementOptions::validate() {
  if (!given_) {
    require_not_given(*app_,
                      {"--hub-height", "--rotor-diameter", "--tip-height", "--minimise", "--rotor-spacing",
                       "--wind-from", "--dwellings", "--setback", "--farm"},
                      "works only with --turbines");
    return;
  }
  refuse_others();
  size_options_.validate();
  const viewshed::TurbineSize& size = size_options_.size();
  if (size.hub.has_value() + size.rotor.has_value() + size.tip.has_value() < 2)
    throw InputError("--turbines: give two of --hub-height, --rotor-diameter and --tip-height");
  const viewshed::TurbineSize completed = size_options_.completed();
  if (!(completed.rotor > 0))
    throw InputError("--tip-height: the tip is no higher than the hub; give --rotor-diameter");
  placement_.hub_height = *completed.hub, placement_.rotor_diameter = *completed.rotor;
  placement_.tip_height = *completed.tip;
  using enum viewshed::Minimised;
  constexpr viewshed::Minimised kChoices[] = {kTips, kHubs, kHeight};
  placement_.minimised = kChoices[parse_choice("--minimise", minimised_text_, {"tips", "hubs", "height"})];
  validate_spacing();
  if (dwellings.empty() != setback_text_.empty()) throw InputError("--dwellings and --setback go together: give both");
  if (!setback_text_.empty())
    placement_.dwellings.emplace().setback = parse_number("--setback", setback_text_, Range::kPositive);
}

void PlacementOptions::refuse_others() const {
  if (app_->get_option("--count")->count() == 0) throw InputError("--turbines: give their number by --count K");
  require_not_given(
      *app_,
      {"--height-field", "--cost-field", "--mast-height", "--mast-cost", "--observer-on", "--frequency", "--fresnel",
       "--power-dbm", "--eirp-dbm", "--budget", "--share", "--k-cover", "--intervisible", "--hub", "--exact-final"},
      "cannot be combined with --turbines; leave it out");
}

void PlacementOptions::validate_spacing() {
  if (spacing_text_.empty()) {
    if (!wind_text_.empty()) throw InputError("--wind-from works only with --rotor-spacing AxB");
    return;
  }
  const std::size_t cross = spacing_text_.find('x');
  const auto multiple = [&](const std::string& text) {
    try {
      return parse_number("", text, Range::kPositive);
    } catch (const InputError&) {
      throw InputError(
          fmt::format("--rotor-spacing '{}': give positive multiples of the rotor's diameter, as 5x3", spacing_text_));
    }
  };
  const double along = multiple(spacing_text_.substr(0, cross));
  const double across = cross == std::string::npos ? along : multiple(spacing_text_.substr(cross + 1));
  if (along != across && wind_text_.empty())
    throw InputError(fmt::format("--rotor-spacing '{}': give --wind-from BEARING too", spacing_text_));
  const double rotor = placement_.rotor_diameter;
  placement_.spacing = {along * rotor, across * rotor, 0};
  if (!wind_text_.empty()) placement_.spacing->wind_from_deg = parse_bearing("--wind-from", wind_text_);
}

Document PlacementOptions::parameters() const {
  Document parameters{{"hub_height_m", placement_.hub_height},
                      {"rotor_diameter_m", placement_.rotor_diameter},
                      {"tip_height_m", placement_.tip_height},
                      {"minimise", minimised_text_}};
  if (const auto& spacing = placement_.spacing) {
    parameters["spacing_along_wind_m"] = spacing->along;
    parameters["spacing_across_wind_m"] = spacing->across;
    parameters["wind_from_deg"] = spacing->wind_from_deg;
  }
  if (placement_.dwellings)
    parameters["dwellings"] = dwellings, parameters["setback_m"] = placement_.dwellings->setback;
  parameters["farm"] = placement_.farm;
  return parameters;
}

}  // namespace itin::cli
