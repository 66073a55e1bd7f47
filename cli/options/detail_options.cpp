#include "options/detail_options.hpp"

#include <itin/error.hpp>

#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

void DetailOptions::declare(CLI::App& app, const std::string& rings_about) {
  begin_group(app, kSurface);
  app.add_option("--tolerance", tolerance_text_,
                 "Vertical tolerance of the surface; 0: every stored point (default: 0)")
      ->type_name("METRES");
  CLI::Option* const rings = app.add_option("--rings", rings_text_,
                                            "Tolerances that grow with the distance from " + rings_about +
                                                ", nearest ring first; features are thinned with the terrain")
                                 ->type_name("RADIUS:TOLERANCE,...");
  if (rings_about.empty()) rings->group("");
}

void DetailOptions::validate() {
  if (!tolerance_text_.empty() && !rings_text_.empty()) throw InputError("--tolerance and --rings exclude each other");
  if (!tolerance_text_.empty()) tolerance_ = parse_number("--tolerance", tolerance_text_, Range::kNotNegative);
  if (!rings_text_.empty()) rings_ = parse_rings("--rings", rings_text_);
}

Detail DetailOptions::detail(Point2 centre) const {
  return has_rings() ? Detail::rings(centre, rings_) : Detail::tolerance(tolerance_);
}

Document DetailOptions::parameters() const {
  if (!has_rings()) return {{"tolerance_m", tolerance_}};
  Document rings = Document::array();
  for (const Ring& ring : rings_) rings.push_back({{"radius_m", ring.radius}, {"tolerance_m", ring.tolerance}});
  return {{"rings", rings}};
}

}  // namespace itin::cli
