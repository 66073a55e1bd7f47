#include "options/foliage_options.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>

#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

void FoliageOptions::declare_foliage(CLI::App& app) {
  begin_group(app, kSurface);
  option_ = app.add_flag("--foliage{0.5}", extinction_text_,
                         "See through themes of vegetation: the share exp(-K a d) of light comes through d metres of a "
                         "leaf area a. K is 0.5, for leaves turned at random; --foliage=K gives another");
}

void FoliageOptions::declare_transmittance(CLI::App& app) {
  app.add_option("--transmittance", transmittance_text_,
                 "The least share of the light by which something is seen (default: 0.5)")
      ->type_name("SHARE");
}

void FoliageOptions::declare_of_seasons(CLI::App& app) {
  of_seasons_ = true;
  declare_foliage(app);
  declare_transmittance(app);
}

void FoliageOptions::declare(CLI::App& app) {
  declare_foliage(app);
  declare_leaf_area(app);
  declare_transmittance(app);
}

void FoliageOptions::declare_of_paths(CLI::App& app) {
  of_paths_ = true;
  declare_foliage(app);
  declare_leaf_area(app);
}

void FoliageOptions::declare_leaf_area(CLI::App& app) {
  app.add_option("--leaf-area", leaf_area_text_,
                 "Square metres of leaves in a cubic metre of wood: on (1, the default), off (0.1, a winter without a "
                 "source), or the field that features have theirs in")
      ->type_name("on|off|FIELD");
}

void FoliageOptions::validate() {
  if (!given()) {
    for (const auto& [option, text] :
         {std::pair("--leaf-area", &leaf_area_text_), std::pair("--transmittance", &transmittance_text_)})
      if (!text->empty()) throw InputError(fmt::format("{} works only with --foliage", option));
    return;
  }
  if (!extinction_text_.empty()) foliage_.extinction = parse_number("--foliage", extinction_text_, Range::kNotNegative);
  if (!leaf_area_text_.empty()) foliage_.set_leaf_area(leaf_area_text_);
  if (transmittance_text_.empty()) return;
  foliage_.least_transmittance = parse_number("--transmittance", transmittance_text_, Range::kNotNegative);
  if (foliage_.least_transmittance > 1)
    throw InputError(fmt::format("--transmittance '{}': give a share from 0 to 1", transmittance_text_));
}

Document FoliageOptions::parameters() const {
  if (!given()) return Document::object();
  Document parameters{{"foliage", foliage_.extinction}};
  if (!of_seasons_)
    parameters["leaf_area"] =
        foliage_.leaf_area_field.empty() ? Document(foliage_.leaf_area) : Document(foliage_.leaf_area_field);
  if (!of_paths_) parameters["transmittance"] = foliage_.least_transmittance;
  return parameters;
}

}  // namespace itin::cli
