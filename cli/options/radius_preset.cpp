#include "options/radius_preset.hpp"

#include <itin/error.hpp>
#include <viewshed/radius_document.hpp>

#include "program/call_files.hpp"
#include "program/values.hpp"

namespace itin::cli {

void RadiusOptions::declare(CLI::App& app) {
  app.add_option("--radius", radius_text_,
                 "How far from each turbine its visibility is assessed (default: by its tip height)")
      ->type_name("METRES");
  reads(app.add_option(
               "--radius-preset", preset_path_,
               "Radius by tip height from this file: {\"source\": ..., \"radii\": [{\"tip_up_to_m\": 50, "
               "\"radius_km\": 15}, ..., {\"radius_km\": 45}]}; a run writes the one it used (default: built in, 15 "
               "to 45 km)")
            ->type_name("FILE"));
}

void RadiusOptions::validate() {
  if (!radius_text_.empty() && !preset_path_.empty())
    throw InputError("--radius and --radius-preset exclude each other");
  if (radius_text_.empty()) return;
  rule_.source = "--radius";
  rule_.fixed = parse_radius("--radius", radius_text_);
}

void RadiusOptions::load() {
  if (!preset_path_.empty()) rule_ = viewshed::read_radius_rule(preset_path_);
}

Document RadiusOptions::document() const {
  return viewshed::radius_document(rule_);
}

}  // namespace itin::cli
